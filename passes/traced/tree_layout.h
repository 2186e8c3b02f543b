#pragma once
// How a tree lies in the memory of the GPU, as 16-byte texels. glsl/traced/tree.glsl reads them.
//
// Boxes are counted in steps of a grid over the tree's own bounds, 16 bits a side, rounded outward.
// threaded: one list of nodes for each octant of directions, depth first with the nearer child first. A ray walks along
//   the list; a node that it misses says where to go on. No stack. One texel a node: per axis the nearer side and, in
//   the upper half, the farther one; then the link, or of a leaf its triangles.
// wide: nodes of four children, four texels each: per axis min and max of the four, then what the four are. Rays that
// go
//   down remember which children are left, one word a level.
// Triangles: three texels, a corner each.

#include "traced/tree_build.h"

namespace bounce {

using Texel = glm::uvec4;

enum class TreeLayout { threaded, wide };

/// A leaf in its word: flag, count − 1, first triangle of the tree.
inline constexpr uint32_t k_leaf_bit = 1u << 29;
inline constexpr uint32_t k_leaf_count_shift = 26;
inline constexpr uint64_t k_max_tree_triangles = uint64_t(1) << k_leaf_count_shift;
inline constexpr uint64_t k_max_tree_texels = uint64_t(1) << 29; ///< links count texels

/// Coordinates to steps: (x − min)·scale. Two steps of margin lie around the bounds, and as much as rounding may move a
/// hit: boxes are larger by that too.
struct TreeGrid {
    glm::vec3 min{0}, scale{1};
    float rounding = 0; ///< metres
    TreeGrid() = default;
    explicit TreeGrid(const Bounds& bounds);
};

/// Texels that write_nodes appends.
uint64_t texels_of_nodes(const BinaryTree& tree, TreeLayout layout);

/// Appends the tree's nodes to `texels`, whose element 0 will be texel `base` of the resource.
void write_nodes(const BinaryTree& tree, const TreeGrid& grid, TreeLayout layout, uint64_t base,
                 std::vector<Texel>& texels);

} // namespace bounce
