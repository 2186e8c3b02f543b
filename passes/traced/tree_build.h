#pragma once
// A binary bounding volume hierarchy over boxes, built by Embree's builder (binned surface area heuristic) on all
// cores.

#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace bounce {

/// Levels of a tree at most: what the stack of the wide layout is sized for (glsl/traced/tree.glsl).
inline constexpr int k_max_tree_depth = 48;
inline constexpr int k_max_leaf_triangles = 8;

struct BinaryNode {
    Bounds bounds;
    uint32_t first = 0; ///< a leaf: of its entries in `order`; otherwise the first child, the other follows its subtree
    uint32_t second = 0; ///< the other child
    uint32_t count = 0;  ///< entries of a leaf; 0: no leaf
    bool leaf() const { return count > 0; }
};

/// Nodes in depth-first order, root first. No primitives: no nodes.
struct BinaryTree {
    std::vector<BinaryNode> nodes;
    std::vector<uint32_t> order; ///< indices of the primitives, leaf after leaf; ascending within a leaf
    int depth = 0;               ///< levels; 1 for a single leaf
    Bounds bounds() const { return nodes.empty() ? Bounds{} : nodes.front().bounds; }
};

/// Cuts a primitive at `position` along `axis`: the boxes of what lies on either side within `bounds`.
using SplitPrimitive =
    std::function<void(uint32_t primitive, int axis, float position, const Bounds& bounds, Bounds& low, Bounds& high)>;

/// Boxes must be finite. Leaves hold at most `leaf_size` ≤ k_max_leaf_triangles. With `split`, large primitives may be
/// cut, and are then in several leaves. Throws Error when memory runs out.
BinaryTree build_tree(std::span<const Bounds> boxes, int leaf_size, const SplitPrimitive& split = {});

} // namespace bounce
