#pragma once
// The scene's triangles as trees: one over all that stands, in the world, and one for each mesh that moves, in its own
// space, which its copies share. A small tree over these, rebuilt each frame, ties them together.

#include "gpu_scene/gpu_scene.h"
#include "traced/tree_layout.h"

#include <array>
#include <map>

namespace bounce {

/// Texels from the start of the resource: one header, then the roots, then the top tree, then trees and triangles.
inline constexpr uint64_t k_header_texels = 3, k_root_texels = 7;

/// What of a material decides where its surface is.
struct AlphaSource {
    AlphaMode mode = AlphaMode::opaque;
    float cutoff = 0, alpha = 1; ///< of mask; of the base colour
    TextureSlot texture;         ///< as the material has it; its image is looked up by the shaders
    bool operator==(const AlphaSource&) const;
};
std::vector<AlphaSource> alpha_sources(const std::vector<Material>& materials);

/// What shapes the trees.
struct TreeSettings {
    TreeLayout layout = TreeLayout::threaded;
    int leaf_size = 4;
    bool cut = false;       ///< large triangles may be in several leaves
    bool share_all = false; ///< every draw refers to its mesh's tree, those that stand too
    bool operator==(const TreeSettings&) const = default;
};

struct TreeCounts {
    uint64_t texels = 0, triangles = 0, nodes = 0, trees = 0, roots = 0;
    int depth = 0; ///< levels of the deepest tree
};

/// Texels that a scene takes for headers and top tree alone.
uint64_t top_texels(uint64_t roots);

class SceneTrees {
  public:
    /// Trees of all draws as they are now. `alpha`: by material. Throws Error when the scene has more triangles
    /// than a tree can number, with both numbers.
    void build(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& indices,
               const std::vector<GpuDraw>& draws, const std::vector<AlphaSource>& alpha, const TreeSettings& settings);
    /// Whether these draws only differ in where those lie that have a tree of their own mesh.
    bool fits(const std::vector<GpuDraw>& draws) const;
    /// Header, roots and top tree for these draws, which must fit: the first texels of the resource. The header tells
    /// how many roots there are, where the top tree is and how many nodes it has, and a digest of where all draws lie.
    std::vector<Texel> top(const std::vector<GpuDraw>& draws) const;
    /// What follows them.
    const std::vector<Texel>& rest() const { return rest_; }
    /// Three texels for each triangle with alpha: texture coordinates of the corners as the base colour's texture takes
    /// them, the corners' alpha without the texture, the cutoff (below 0: blended), the material.
    const std::vector<Texel>& alpha() const { return alpha_; }
    const TreeCounts& counts() const { return counts_; }

  private:
    /// A tree with its triangles, in the resource.
    struct Tree {
        uint32_t first_node = 0, nodes_an_octant = 0, first_triangle = 0; ///< texels, nodes, texels
        TreeGrid grid;
        Bounds bounds;
    };
    /// A triangle before it is placed: corners, and what its texels carry beside them.
    struct Triangle {
        glm::vec3 corners[3];
        uint32_t draw, first_corner, material;
    };
    struct Sources {
        const std::vector<Vertex>& vertices;
        const std::vector<uint32_t>& indices;
        const std::vector<AlphaSource>& alpha;
    };
    void add_triangles(const Sources& sources, const GpuDraw& draw, uint32_t number, bool in_world,
                       std::vector<Triangle>& triangles) const;
    int add_tree(const Sources& sources, const std::vector<Triangle>& triangles);
    uint32_t add_alpha(const Sources& sources, const Triangle& triangle);
    bool shares(const GpuDraw& draw) const;

    struct Root {
        int tree;
        int draw; ///< −1: what stands, in the world
    };
    TreeSettings settings_;
    std::vector<Tree> trees_;
    std::vector<Root> roots_;
    std::vector<GpuDraw> draws_;
    std::vector<Texel> rest_, alpha_;
    uint64_t rest_base_ = 0;
    TreeCounts counts_;
};

} // namespace bounce
