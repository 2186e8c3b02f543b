#include "traced/tree_build.h"

#include "core/error.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <new>

namespace bounce {

namespace {

/// What the builder's callbacks make; its memory is the builder's.
struct BuiltNode {
    RTCBounds bounds[2];
    BuiltNode* children[2] = {nullptr, nullptr};
    uint32_t count = 0; ///< of a leaf
    uint32_t entries[k_max_leaf_triangles];
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode;
}
void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuiltNode*>(node)->children[i] = static_cast<BuiltNode*>(children[i]);
}
void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuiltNode*>(node)->bounds[i] = *bounds[i];
}
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode;
    leaf->count = uint32_t(count);
    for (size_t i = 0; i < count; ++i)
        leaf->entries[i] = primitives[i].primID;
    // Parallel builds order a leaf by chance.
    std::sort(leaf->entries, leaf->entries + count);
    return leaf;
}

Bounds bounds_of(const RTCBounds& b) {
    Bounds out;
    out.min = {b.lower_x, b.lower_y, b.lower_z};
    out.max = {b.upper_x, b.upper_y, b.upper_z};
    return out;
}

/// Copies the builder's nodes into one array, depth first.
uint32_t copy_node(const BuiltNode& node, const Bounds& bounds, int level, BinaryTree& tree) {
    const auto index = uint32_t(tree.nodes.size());
    tree.nodes.emplace_back().bounds = bounds;
    tree.depth = std::max(tree.depth, level);
    if (node.count) {
        tree.nodes[index].first = uint32_t(tree.order.size());
        tree.nodes[index].count = node.count;
        tree.order.insert(tree.order.end(), node.entries, node.entries + node.count);
        return index;
    }
    const uint32_t first = copy_node(*node.children[0], bounds_of(node.bounds[0]), level + 1, tree);
    const uint32_t second = copy_node(*node.children[1], bounds_of(node.bounds[1]), level + 1, tree);
    tree.nodes[index].first = first;
    tree.nodes[index].second = second;
    return index;
}

class Builder {
  public:
    Builder() : device_(rtcNewDevice(nullptr)) {
        if (!device_)
            throw Error(
                fmt::format("Embree cannot start on this processor (error {})", int(rtcGetDeviceError(nullptr))));
        bvh_ = rtcNewBVH(device_);
    }
    ~Builder() {
        rtcReleaseBVH(bvh_);
        rtcReleaseDevice(device_);
    }
    Builder(const Builder&) = delete;
    Builder& operator=(const Builder&) = delete;

    const BuiltNode* build(std::vector<RTCBuildPrimitive>& primitives, int leaf_size) {
        RTCBuildArguments arguments = rtcDefaultBuildArguments();
        arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
        arguments.maxBranchingFactor = 2;
        arguments.maxDepth = k_max_tree_depth;
        arguments.maxLeafSize = unsigned(leaf_size);
        arguments.traversalCost = 1;
        arguments.intersectionCost = 0.25f; // triangles of a leaf are tested together
        arguments.bvh = bvh_;
        arguments.primitives = primitives.data();
        arguments.primitiveCount = primitives.size();
        arguments.primitiveArrayCapacity = primitives.capacity();
        arguments.createNode = create_node;
        arguments.setNodeChildren = set_children;
        arguments.setNodeBounds = set_bounds;
        arguments.createLeaf = create_leaf;
        const auto* root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
        if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE || !root)
            throw Error(fmt::format("Embree could not build a tree over {} boxes (error {}{})", primitives.size(),
                                    int(error), error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
        return root;
    }

  private:
    RTCDevice device_;
    RTCBVH bvh_ = nullptr;
};

} // namespace

BinaryTree build_tree(std::span<const Bounds> boxes, int leaf_size) {
    BinaryTree tree;
    if (boxes.empty()) return tree;
    std::vector<RTCBuildPrimitive> primitives(boxes.size());
    Bounds whole;
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Bounds& b = boxes[i];
        primitives[i] = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, uint32_t(i)};
        whole.add(b);
    }
    Builder builder;
    const BuiltNode* root = builder.build(primitives, std::clamp(leaf_size, 1, k_max_leaf_triangles));
    tree.order.reserve(boxes.size());
    copy_node(*root, whole, 1, tree);
    return tree;
}

} // namespace bounce
