#include "traced/tree_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bounce {

namespace {

constexpr float k_steps = 65535, k_margin = 2;

struct StepBox {
    std::array<uint32_t, 3> low, high;
};

/// Rounded outward, and a sixteenth of a step more: what rounding takes from a ray in these units is below that.
StepBox step_box(const Bounds& bounds, const TreeGrid& grid) {
    StepBox box{};
    for (int axis = 0; axis < 3; ++axis) {
        const float low = (bounds.min[axis] - grid.min[axis] - grid.rounding) * grid.scale[axis];
        const float high = (bounds.max[axis] - grid.min[axis] + grid.rounding) * grid.scale[axis];
        box.low[size_t(axis)] = uint32_t(std::clamp(std::floor(low - 0.0625f), 0.0f, k_steps));
        box.high[size_t(axis)] = uint32_t(std::clamp(std::ceil(high + 0.0625f), 0.0f, k_steps));
    }
    return box;
}

uint32_t leaf_word(const BinaryNode& node) {
    return k_leaf_bit | ((node.count - 1) << k_leaf_count_shift) | node.first;
}

/// The axis along which two boxes are farthest apart, and whether the first one is the lower there.
struct Order {
    int axis = 0;
    bool first_is_lower = true;
};
Order order_of(const Bounds& first, const Bounds& second) {
    Order order;
    const glm::vec3 apart = second.centre() - first.centre();
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(apart[axis]) > std::abs(apart[order.axis])) order.axis = axis;
    order.first_is_lower = apart[order.axis] >= 0;
    return order;
}

/// Nodes below a node and itself; index as in the tree.
std::vector<uint32_t> subtree_sizes(const BinaryTree& tree) {
    std::vector<uint32_t> sizes(tree.nodes.size(), 1);
    for (size_t i = tree.nodes.size(); i-- > 0;) {
        const BinaryNode& node = tree.nodes[i];
        if (!node.leaf()) sizes[i] = 1 + sizes[node.first] + sizes[node.second];
    }
    return sizes;
}

class ThreadedWriter {
  public:
    ThreadedWriter(const BinaryTree& tree, const TreeGrid& grid) : tree_(tree), sizes_(subtree_sizes(tree)) {
        boxes_.reserve(tree.nodes.size());
        orders_.reserve(tree.nodes.size());
        for (const BinaryNode& node : tree.nodes) {
            boxes_.push_back(step_box(node.bounds, grid));
            orders_.push_back(node.leaf() ? Order{}
                                          : order_of(tree.nodes[node.first].bounds, tree.nodes[node.second].bounds));
        }
    }

    /// `out`: of the octant's first node; `at`: the texel it will be.
    void write(int octant, Texel* out, uint64_t at) const {
        std::vector<uint32_t> pending{0};
        while (!pending.empty()) {
            const uint32_t index = pending.back();
            pending.pop_back();
            const BinaryNode& node = tree_.nodes[index];
            const StepBox& box = boxes_[index];
            for (int axis = 0; axis < 3; ++axis) {
                const uint32_t low = box.low[size_t(axis)], high = box.high[size_t(axis)];
                (*out)[axis] = (octant >> axis) & 1 ? high | (low << 16) : low | (high << 16);
            }
            (*out)[3] = node.leaf() ? leaf_word(node) : uint32_t(at + sizes_[index]);
            ++out, ++at;
            if (node.leaf()) continue;
            const Order& order = orders_[index];
            const bool negative = (octant >> order.axis) & 1;
            const bool first_is_nearer = order.first_is_lower != negative;
            pending.push_back(first_is_nearer ? node.second : node.first);
            pending.push_back(first_is_nearer ? node.first : node.second);
        }
    }

  private:
    const BinaryTree& tree_;
    std::vector<uint32_t> sizes_;
    std::vector<StepBox> boxes_;
    std::vector<Order> orders_;
};

/// Children of a wide node: those of both children of a binary one, lower pair first and in each pair the lower first.
struct WideChildren {
    std::array<int64_t, 4> child{-1, -1, -1, -1}; ///< indices of binary nodes; −1: none
    std::array<int, 3> axis{0, 0, 0};             ///< that tells the pairs apart, and the two of each pair
};
WideChildren wide_children(const BinaryTree& tree, uint32_t index) {
    WideChildren wide;
    const BinaryNode& node = tree.nodes[index];
    if (node.leaf()) { // a tree of one leaf
        wide.child[0] = index;
        return wide;
    }
    const Order order = order_of(tree.nodes[node.first].bounds, tree.nodes[node.second].bounds);
    wide.axis[0] = order.axis;
    const std::array<uint32_t, 2> pair{order.first_is_lower ? node.first : node.second,
                                       order.first_is_lower ? node.second : node.first};
    for (size_t p = 0; p < 2; ++p) {
        const BinaryNode& half = tree.nodes[pair[p]];
        if (half.leaf()) {
            wide.child[2 * p] = pair[p];
            continue;
        }
        const Order within = order_of(tree.nodes[half.first].bounds, tree.nodes[half.second].bounds);
        wide.axis[p + 1] = within.axis;
        wide.child[2 * p] = within.first_is_lower ? half.first : half.second;
        wide.child[2 * p + 1] = within.first_is_lower ? half.second : half.first;
    }
    return wide;
}

uint64_t wide_node_count(const BinaryTree& tree) {
    uint64_t count = 0;
    std::vector<uint32_t> pending{0};
    while (!pending.empty()) {
        const uint32_t index = pending.back();
        pending.pop_back();
        ++count;
        for (const int64_t child : wide_children(tree, index).child)
            if (child >= 0 && !tree.nodes[size_t(child)].leaf()) pending.push_back(uint32_t(child));
    }
    return count;
}

void write_wide(const BinaryTree& tree, const TreeGrid& grid, uint64_t base, std::vector<Texel>& texels) {
    struct Pending {
        uint32_t node;
        size_t place; ///< of its first texel in `texels`
    };
    auto reserve = [&] {
        texels.resize(texels.size() + 4, Texel(0));
        return texels.size() - 4;
    };
    std::vector<Pending> pending{{0, reserve()}};
    while (!pending.empty()) {
        const auto [index, place] = pending.back();
        pending.pop_back();
        const WideChildren wide = wide_children(tree, index);
        for (size_t slot = 4; slot-- > 0;) { // so that the first child is taken next
            StepBox box{{65535, 65535, 65535}, {0, 0, 0}};
            uint32_t word = k_leaf_bit;
            if (wide.child[slot] >= 0) {
                const auto child = uint32_t(wide.child[slot]);
                const BinaryNode& node = tree.nodes[child];
                box = step_box(node.bounds, grid);
                if (node.leaf()) {
                    word = leaf_word(node);
                } else {
                    pending.push_back({child, reserve()});
                    word = uint32_t(base + pending.back().place);
                }
            }
            if (slot < 3) word |= uint32_t(wide.axis[slot]) << 30;
            for (size_t axis = 0; axis < 3; ++axis)
                texels[place + axis][int(slot)] = box.low[axis] | (box.high[axis] << 16);
            texels[place + 3][int(slot)] = word;
        }
    }
}

} // namespace

TreeGrid::TreeGrid(const Bounds& bounds) {
    if (bounds.empty()) return;
    const glm::vec3 size = bounds.size();
    const glm::vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const float largest = std::max({size.x, size.y, size.z, farthest.x, farthest.y, farthest.z, 1e-30f});
    rounding = 0x1p-21f * largest;
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis] = (k_steps - 2 * k_margin) / (size[axis] + 2 * rounding);
        min[axis] = bounds.min[axis] - rounding - k_margin / scale[axis];
    }
}

uint64_t texels_of_nodes(const BinaryTree& tree, TreeLayout layout) {
    if (tree.nodes.empty()) return 0;
    return layout == TreeLayout::threaded ? 8 * tree.nodes.size() : 4 * wide_node_count(tree);
}

void write_nodes(const BinaryTree& tree, const TreeGrid& grid, TreeLayout layout, uint64_t base,
                 std::vector<Texel>& texels) {
    if (tree.nodes.empty()) return;
    if (layout == TreeLayout::wide) return write_wide(tree, grid, base, texels);
    const size_t start = texels.size(), count = tree.nodes.size();
    texels.resize(start + 8 * count);
    const ThreadedWriter writer(tree, grid);
    for (size_t octant = 0; octant < 8; ++octant) {
        const size_t place = start + octant * count;
        writer.write(int(octant), &texels[place], base + place);
    }
}

} // namespace bounce
