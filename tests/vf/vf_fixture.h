#pragma once
// Runs `vf` on scenes made in memory, and reads back what it built.

#include "support/made_scenes.h"
#include "support/start_points.h"
#include "vf/grid.h"

#include <fmt/format.h>
#include <memory>

namespace bounce {

using VfSets = std::vector<std::pair<std::string, std::string>>;

class VfTest : public SceneGraphTest {
  protected:
    /// `resources`, `passes`: more of both in a graph that extends `vf`.
    SceneRunner& make(Scene scene, std::vector<Light> lights, const VfSets& sets, const std::string& resources = {},
                      const std::string& passes = {}, glm::ivec2 picture = {16, 16}) {
        VfSets all{{"shadow_maps.resolution", "256"}, {"vf_proxies.proxies", "600"}, {"vf_proxies.cells", "4"}};
        all.insert(all.end(), sets.begin(), sets.end());
        std::string file = fmt::format(
            R"("extends":"vf","resources":{{{}"vf.irradiance":{{"format":"rgba32f"}},"gbuffer.normal":{{"format":"rgba32f"}},
               "gbuffer.geometric_normal":{{"format":"rgba32f"}}}},"passes":[{}])",
            resources, passes);
        run = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(file), all, picture);
        run->camera.position = {0.9f, 1.1f, 2.4f};
        run->camera.target = {0, 0.4f, 0};
        run->camera.vfov = 1.0f;
        run->frame();
        return *run;
    }
    VfGrid grid() const { return run->read_buffer<VfGrid>("vf.grid").at(0); }
    /// In the order of cells: of each its own, then copies.
    std::vector<VfProxy> entries() const {
        std::vector<VfProxy> all = run->read_buffer<VfProxy>("vf.proxies");
        all.resize(std::min<size_t>(all.size(), grid().entries));
        return all;
    }
    /// Without copies.
    std::vector<VfProxy> proxies() const {
        std::vector<VfProxy> own;
        for (const VfProxy& proxy : entries())
            if (proxy.area > 0) own.push_back(proxy);
        return own;
    }
    std::vector<glm::uvec2> ranges() const { return run->read_buffer<glm::uvec2>("vf.ranges"); }

    static glm::ivec3 cell_at(const VfGrid& grid, glm::vec3 p) {
        return glm::ivec3(glm::floor((p - grid.origin) / grid.cell));
    }
    static int index_of(const VfGrid& grid, glm::ivec3 v) { return (v.z * grid.size.y + v.y) * grid.size.x + v.x; }

    std::unique_ptr<SceneRunner> run;
};

/// A light that sees most of blocks().
inline std::vector<Light> light_above_blocks() {
    return {spot_light({0.6f, 2.6f, 0.8f}, {-0.2f, -1, -0.3f}, {9, 6, 3}, 25, 45)};
}

/// Where a ray meets a disc; < 0: nowhere. Double precision.
inline double meet_disc(const VfProxy& proxy, glm::dvec3 origin, glm::dvec3 direction) {
    glm::dvec3 n(proxy.normal), centre(proxy.position);
    double along = glm::dot(n, direction);
    if (std::abs(along) < 1e-6) return -1;
    double t = glm::dot(n, centre - origin) / along;
    return t > 0 && glm::length(origin + t * direction - centre) <= double(proxy.radius) ? t : -1;
}

} // namespace bounce
