// The trees themselves: every primitive in one leaf, boxes around what they hold, bounded leaves and depth.
#include "traced/tree_layout.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

using namespace bounce;

namespace {

std::vector<Bounds> random_boxes(size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes) {
        const glm::vec3 at(10 * unit(random), unit(random), 3 * unit(random));
        const float size = 0.2f * unit(random) * unit(random);
        box.add(at);
        box.add(at + size * glm::vec3(unit(random), unit(random), unit(random)));
    }
    return boxes;
}

bool holds(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

void expect_sound(const BinaryTree& tree, const std::vector<Bounds>& boxes, int leaf_size) {
    std::vector<uint32_t> order = tree.order;
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), boxes.size());
    for (uint32_t i = 0; i < order.size(); ++i)
        ASSERT_EQ(order[i], i);
    EXPECT_LE(tree.depth, k_max_tree_depth);
    size_t in_leaves = 0;
    for (const BinaryNode& node : tree.nodes) {
        if (!node.leaf()) {
            ASSERT_TRUE(holds(node.bounds, tree.nodes[node.first].bounds));
            ASSERT_TRUE(holds(node.bounds, tree.nodes[node.second].bounds));
            continue;
        }
        ASSERT_LE(int(node.count), leaf_size);
        in_leaves += node.count;
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            ASSERT_TRUE(holds(node.bounds, boxes[tree.order[i]]));
    }
    EXPECT_EQ(in_leaves, boxes.size());
}

} // namespace

TEST(Tree, HoldsEveryBoxOnce) {
    for (const size_t count : {1, 2, 9, 1000, 30000})
        for (const int leaf_size : {1, 4, 8}) {
            const std::vector<Bounds> boxes = random_boxes(count, unsigned(count));
            expect_sound(build_tree(boxes, leaf_size), boxes, leaf_size);
        }
    EXPECT_TRUE(build_tree({}, 4).nodes.empty());
}

/// Nothing tells such boxes apart.
TEST(Tree, BoxesInOnePlaceAreHalvedAllTheSame) {
    const std::vector<Bounds> boxes(50000, random_boxes(1, 7)[0]);
    expect_sound(build_tree(boxes, 8), boxes, 8);
}

/// Each box ten times as far away and as large as the one before it: as lopsided as trees get.
TEST(Tree, LopsidedBoxesKeepTheDepth) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 2000; ++i) {
        Bounds& box = boxes.emplace_back();
        const float at = std::pow(1.03f, float(i % 1500));
        box.add({at, 0, 0});
        box.add({1.001f * at, 0.001f * at, 0.001f * at});
    }
    expect_sound(build_tree(boxes, 1), boxes, 1);
}

/// Stored boxes hold the real ones, with a margin for rounding, in all eight lists.
TEST(Tree, StoredBoxesHoldTheRealOnes) {
    const std::vector<Bounds> boxes = random_boxes(500, 3);
    const BinaryTree tree = build_tree(boxes, 4);
    const TreeGrid grid(tree.bounds());
    std::vector<Texel> texels;
    constexpr uint64_t k_base = 1000;
    write_nodes(tree, grid, TreeLayout::threaded, k_base, texels);
    ASSERT_EQ(texels.size(), texels_of_nodes(tree, TreeLayout::threaded));
    for (size_t octant = 0; octant < 8; ++octant) {
        size_t leaves = 0, first = octant * tree.nodes.size();
        for (size_t i = 0; i < tree.nodes.size(); ++i) {
            const Texel& node = texels[first + i];
            if (!(node.w & k_leaf_bit)) {
                EXPECT_GT(node.w, k_base + first + i + 2);
                EXPECT_LE(node.w, k_base + first + tree.nodes.size());
                continue;
            }
            ++leaves;
            const uint32_t begin = node.w & ((1u << k_leaf_count_shift) - 1);
            const uint32_t count = ((node.w >> k_leaf_count_shift) & 7) + 1;
            for (uint32_t k = begin; k < begin + count; ++k) {
                const Bounds& box = boxes[tree.order[k]];
                for (int axis = 0; axis < 3; ++axis) {
                    const bool negative = (octant >> axis) & 1;
                    const float near = float(node[axis] & 0xffff), far = float(node[axis] >> 16);
                    const float low = negative ? far : near, high = negative ? near : far;
                    EXPECT_LT(low, (box.min[axis] - grid.min[axis]) * grid.scale[axis]);
                    EXPECT_GT(high, (box.max[axis] - grid.min[axis]) * grid.scale[axis]);
                }
            }
        }
        EXPECT_GT(leaves, 500u / 4 - 1);
    }
}
