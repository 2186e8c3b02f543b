#pragma once
// The layers of reflective shadow maps, worked out on the CPU from the maps and the boundaries.

#include "lrsm/rsm_fixture.h"

#include <functional>

namespace bounce {

/// What one block of 2×2 texels adds to one layer, as Table 1 of the paper has it: weighted by opacity.
struct LayerTexel {
    glm::dvec4 radiance{0}, normal{0}, depth{0};
};

class LayersOracle {
  public:
    LayersOracle(const SceneRunner& run, int depth_layers, int normal_layers)
        : maps(run), partitions(run.read_buffer<LrsmPartition>("lrsm.partitions")), depth_layers_(depth_layers),
          normal_layers_(normal_layers) {}

    ReflectiveShadowMaps maps;
    std::vector<LrsmPartition> partitions;

    /// From where to where depth layer d reaches, with its overlaps.
    glm::dvec2 range(int view, int d) const {
        const LrsmPartition& p = partitions[size_t(view)];
        return {p.depth[d] - (d > 0 ? 0.5 * p.overlap : 0.0),
                p.depth[d + 1] + (d + 1 < p.depth_layers ? 0.5 * p.overlap : 0.0)};
    }
    /// Whether a texel belongs to a layer: the scene's ends are open, boundaries of ⟨n·l⟩ belong to the part above.
    bool belongs(int view, int x, int y, int d, int k) const {
        if (!maps.holds(view, x, y)) return false;
        const LrsmPartition& p = partitions[size_t(view)];
        double z = maps.distance(view, x, y);
        glm::dvec2 r = range(view, d);
        if ((d > 0 && z < r.x) || (d + 1 < p.depth_layers && z > r.y) || d >= p.depth_layers) return false;
        double cosine = maps.radiance_at(view, x, y).a;
        return (k == 0 || cosine >= p.normal[k]) && (k + 1 == normal_layers_ || cosine < p.normal[k + 1]);
    }
    /// Whether float and double may disagree about a texel's depth layers.
    bool borderline(int view, int x, int y) const {
        if (!maps.holds(view, x, y)) return false;
        const LrsmPartition& p = partitions[size_t(view)];
        double z = maps.distance(view, x, y);
        for (int d = 0; d + 1 < p.depth_layers; ++d)
            for (double boundary : {range(view, d).y, range(view, d + 1).x})
                if (std::abs(z - boundary) < 1e-6 * p.depth[p.depth_layers]) return true;
        return false;
    }
    LayerTexel block(int view, int bx, int by, int d, int k) const {
        LayerTexel sum;
        glm::dvec2 r = range(view, d);
        for (int i = 0; i < 4; ++i) {
            int x = 2 * bx + (i & 1), y = 2 * by + (i >> 1);
            if (!belongs(view, x, y, d, k)) continue;
            double warped = glm::clamp((maps.distance(view, x, y) - r.x) / (r.y - r.x), 0.0, 1.0);
            sum.radiance += 0.25 * maps.radiance_at(view, x, y);
            sum.normal += 0.25 * glm::dvec4(glm::dvec3(maps.normal_at(view, x, y)), 1);
            sum.depth += 0.25 * glm::dvec4(warped, warped * warped, 1, 0);
        }
        return sum;
    }
    int texels_of(int view, int d, int k) const {
        int count = 0;
        for (int y = 0; y < maps.size.y; ++y)
            for (int x = 0; x < maps.size.x; ++x)
                count += belongs(view, x, y, d, k);
        return count;
    }
    void each_layer(const std::function<void(int view, int d, int k)>& action) const {
        for (int view = 0; view < maps.size.z; ++view)
            for (int d = 0; d < depth_layers_; ++d)
                for (int k = 0; k < normal_layers_; ++k)
                    action(view, d, k);
    }
    static size_t table_index(int view, int d, int k) {
        return size_t((view * k_max_depth_layers + d) * k_max_normal_layers + k);
    }

  private:
    int depth_layers_, normal_layers_;
};

/// Mip 0 of the layers, read back.
struct LayerTextures {
    explicit LayerTextures(const SceneRunner& run, int mip = 0)
        : size(mip_size(run.texture("lrsm.radiance").desc(), mip)), radiance(run.read("lrsm.radiance", mip)),
          normal(run.read("lrsm.normal", mip)), depth(run.read("lrsm.depth", mip)) {}
    glm::ivec3 size;
    std::vector<float> radiance, normal, depth;

    LayerTexel at(int place, int x, int y) const {
        size_t texel = (size_t(place) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x);
        return {ReflectiveShadowMaps::four(radiance, texel), ReflectiveShadowMaps::four(normal, texel),
                ReflectiveShadowMaps::four(depth, texel)};
    }
};

/// The greatest error of a stored texel in units of its formats' rounding: 1 is what half floats and 16-bit unorms
/// allow.
inline double rounding_error(const LayerTexel& got, const LayerTexel& expected) {
    double worst = 0;
    for (int c = 0; c < 4; ++c) {
        worst =
            std::max(worst, std::abs(got.radiance[c] - expected.radiance[c]) / half_tolerance(expected.radiance[c]));
        worst = std::max(worst, std::abs(got.normal[c] - expected.normal[c]) / half_tolerance(expected.normal[c]));
        // Half a step, and what a float's depth leaves uncertain after warping.
        if (c < 3) worst = std::max(worst, std::abs(got.depth[c] - expected.depth[c]) / (0.5 / 65535 + 5e-6));
    }
    return worst;
}

} // namespace bounce
