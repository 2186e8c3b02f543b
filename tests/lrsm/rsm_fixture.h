#pragma once
// Reflective shadow maps and layers as the graph left them, and scenes to look at.

#include "lrsm/partition.h"
#include "support/made_scenes.h"
#include "surface/shadow_views.h"

#include <cmath>

namespace bounce {

inline constexpr const char* k_mips_pass = R"({"id":"lrsm_mips","type":"compute","shader":"lrsm/mips.comp",
    "bind":{"lrsm.finer_radiance":{"resource":"lrsm.radiance","mip":"iteration - 1"},
            "lrsm.finer_normal":{"resource":"lrsm.normal","mip":"iteration - 1"},
            "lrsm.finer_depth":{"resource":"lrsm.depth","mip":"iteration - 1"},
            "lrsm.coarser_radiance":{"resource":"lrsm.radiance","mip":"iteration"},
            "lrsm.coarser_normal":{"resource":"lrsm.normal","mip":"iteration"},
            "lrsm.coarser_depth":{"resource":"lrsm.depth","mip":"iteration"}},
    "repeat":{"over":"mips","of":"lrsm.radiance","from":1}})";

/// One light of each kind: eight views.
inline std::vector<Light> one_of_each() {
    return {spot_light({0.3f, 3, 0.2f}, {-0.1f, -1, 0.1f}, {9, 6, 3}, 20, 42),
            point_light({0.9f, 1.6f, 0.7f}, {3, 4, 5}), directional_light({-0.5f, -1, -0.3f}, {2, 2, 1})};
}

/// The maps of all views, read back.
struct ReflectiveShadowMaps {
    explicit ReflectiveShadowMaps(const SceneRunner& run)
        : views(run.read_buffer<ShadowView>("rsm.views")), size(run.texture("rsm.depth").desc().size),
          radiance(run.read("rsm.radiance")), normal(run.read("rsm.normal")), depth(run.read("rsm.depth")) {}

    std::vector<ShadowView> views;
    glm::ivec3 size;
    std::vector<float> radiance, normal, depth;

    size_t texel(int view, int x, int y) const {
        return (size_t(view) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x);
    }
    bool holds(int view, int x, int y) const { return depth[texel(view, x, y)] > 0; }
    /// Metres along the view.
    double distance(int view, int x, int y) const {
        const ShadowView& v = views[size_t(view)];
        double stored = depth[texel(view, x, y)];
        return v.range > 0 ? (1 - stored) * v.range : v.near_plane / stored;
    }
    glm::dvec4 radiance_at(int view, int x, int y) const { return four(radiance, texel(view, x, y)); }
    glm::dvec4 normal_at(int view, int x, int y) const { return four(normal, texel(view, x, y)); }

    static glm::dvec4 four(const std::vector<float>& values, size_t texel) {
        return {values[4 * texel], values[4 * texel + 1], values[4 * texel + 2], values[4 * texel + 3]};
    }
};

/// From where to where the scene reaches along a view, metres.
inline glm::dvec2 extent_along(const ShadowView& view, const Bounds& bounds) {
    double nearest = 1e300, furthest = -1e300;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                     (corner & 4) ? bounds.max.z : bounds.min.z);
        double z = glm::dot(p - glm::dvec3(view.origin), glm::dvec3(view.direction));
        nearest = std::min(nearest, z), furthest = std::max(furthest, z);
    }
    nearest = std::max(nearest, view.range > 0 ? 0.0 : double(view.near_plane));
    return {nearest, std::max(nearest, furthest)}; // all of it may lie behind one face of a point light
}

/// Half floats keep 11 bits; some drivers truncate. Below, the smallest normal half's last bit.
inline double half_tolerance(double value) {
    return std::abs(value) / 1024 + 6e-8;
}

} // namespace bounce
