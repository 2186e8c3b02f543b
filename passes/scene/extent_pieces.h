#pragma once
// What the extent of a scene is found from: its triangles, and the parts of what moves at each moment.

#include "scene/extent.h"
#include "scene/motion.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

namespace bounce {

// Rule 1 of scene_extent: where all but a few triangles would be less than a voxel of a grid of 256³, those few are
// strays if each is so large a share of the bounds that it makes them as long as they are.
constexpr float k_collapse = 256;
constexpr float k_spanning_share = 0.125f;
constexpr double k_few_strays = 1.0 / 3;

/// A triangle, or a part of a moving mesh at one moment.
struct ScenePiece {
    Bounds box;
    double area = 0, emission = 0;      ///< m², W/sr or so: weighted by the share of moments
    double triangles = 0;               ///< likewise
    float reach = 0;                    ///< longest edge of the largest triangle's box, as at the start
    bool moving = false, later = false; ///< a part of what moves; after the start
};

struct PieceSum {
    Bounds box;
    double area = 0, emission = 0, triangles = 0;
    void add(const ScenePiece& piece) {
        box.add(piece.box);
        area += piece.area;
        emission += piece.emission;
        triangles += piece.triangles;
    }
    void add(const PieceSum& other) {
        box.add(other.box);
        area += other.area;
        emission += other.emission;
        triangles += other.triangles;
    }
};

/// Goes through the scene's pieces as often as it is asked to, without a copy of all triangles.
class ScenePieces {
  public:
    ScenePieces(const Scene& scene, float time, bool over_animation)
        : scene_(scene), worlds_(world_matrices(scene, time)), over_animation_(over_animation) {
        if (over_animation) add_movers();
    }

    template <class See>
    void visit(See&& see) const {
        each_static([&](size_t node, const Primitive& primitive) {
            each_triangle(primitive, worlds_[node], [&](uint32_t, const ScenePiece& piece) { see(piece); });
        });
        for (const ScenePiece& piece : moving_)
            see(piece);
    }
    bool moves() const { return !moving_.empty(); }

  private:
    template <class See>
    void each_static(See&& see) const {
        for (size_t n = 0; n < scene_.nodes.size(); ++n) {
            const Node& node = scene_.nodes[n];
            if (node.mesh < 0 || (over_animation_ && node.dynamic)) continue;
            for (const Primitive& primitive : scene_.meshes[size_t(node.mesh)].primitives)
                see(n, primitive);
        }
    }

    template <class See>
    void each_triangle(const Primitive& primitive, const glm::mat4& world, See&& see) const {
        const glm::vec3& emission = scene_.materials[size_t(primitive.material)].emission;
        double glow = std::max({emission.r, emission.g, emission.b});
        for (uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
            glm::vec3 p[3];
            ScenePiece piece;
            for (uint32_t k = 0; k < 3; ++k) {
                p[k] = world_point(world, scene_.vertices[scene_.indices[primitive.first_index + i + k]].position);
                piece.box.add(p[k]);
            }
            glm::dvec3 a(p[0]), e1 = glm::dvec3(p[1]) - a, e2 = glm::dvec3(p[2]) - a;
            piece.area = 0.5 * glm::length(glm::cross(e1, e2));
            piece.emission = piece.area * glow;
            piece.triangles = 1;
            piece.reach = longest_edge(piece.box);
            see(i, piece);
        }
    }

    /// A moving primitive counts as one piece for each moment. Triangles that stray from their own mesh are one more.
    void add_movers();
    void add_parts(size_t node, const Primitive& primitive, std::vector<Mover>& movers,
                   std::vector<ScenePiece>& parts) const;

    const Scene& scene_;
    std::vector<glm::mat4> worlds_;
    bool over_animation_;
    std::vector<ScenePiece> moving_;
};

} // namespace bounce
