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

RTCBounds embree_bounds(const Bounds& b) {
    RTCBounds out{};
    out.lower_x = b.min.x, out.lower_y = b.min.y, out.lower_z = b.min.z;
    out.upper_x = b.max.x, out.upper_y = b.max.y, out.upper_z = b.max.z;
    return out;
}

void split_primitive(const RTCBuildPrimitive* primitive, unsigned axis, float position, RTCBounds* low, RTCBounds* high,
                     void* split) {
    Bounds bounds, below, above;
    bounds.min = {primitive->lower_x, primitive->lower_y, primitive->lower_z};
    bounds.max = {primitive->upper_x, primitive->upper_y, primitive->upper_z};
    (*static_cast<const SplitPrimitive*>(split))(primitive->primID, int(axis), position, bounds, below, above);
    *low = embree_bounds(below);
    *high = embree_bounds(above);
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

    const BuiltNode* build(std::vector<RTCBuildPrimitive>& primitives, size_t count, int leaf_size,
                           const SplitPrimitive& split) {
        RTCBuildArguments arguments = rtcDefaultBuildArguments();
        arguments.buildQuality = split ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
        if (split) {
            arguments.splitPrimitive = split_primitive;
            arguments.userPtr = const_cast<SplitPrimitive*>(&split);
        }
        arguments.maxBranchingFactor = 2;
        arguments.maxDepth = k_max_tree_depth;
        arguments.maxLeafSize = unsigned(leaf_size);
        arguments.traversalCost = 1;
        arguments.intersectionCost = 0.25f; // triangles of a leaf are tested together
        arguments.bvh = bvh_;
        arguments.primitives = primitives.data();
        arguments.primitiveCount = count;
        arguments.primitiveArrayCapacity = primitives.size();
        arguments.createNode = create_node;
        arguments.setNodeChildren = set_children;
        arguments.setNodeBounds = set_bounds;
        arguments.createLeaf = create_leaf;
        const auto* root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
        if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE || !root)
            throw Error(fmt::format("Embree could not build a tree over {} boxes (error {}{})", count, int(error),
                                    error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
        return root;
    }

  private:
    RTCDevice device_;
    RTCBVH bvh_ = nullptr;
};

} // namespace

BinaryTree build_tree(std::span<const Bounds> boxes, int leaf_size, const SplitPrimitive& split) {
    BinaryTree tree;
    if (boxes.empty()) return tree;
    std::vector<RTCBuildPrimitive> primitives(split ? boxes.size() + boxes.size() / 2
                                                    : boxes.size()); // room for pieces
    Bounds whole;
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Bounds& b = boxes[i];
        primitives[i] = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, uint32_t(i)};
        whole.add(b);
    }
    Builder builder;
    const BuiltNode* root =
        builder.build(primitives, boxes.size(), std::clamp(leaf_size, 1, k_max_leaf_triangles), split);
    tree.order.reserve(boxes.size());
    copy_node(*root, whole, 1, tree);
    return tree;
}

} // namespace bounce
