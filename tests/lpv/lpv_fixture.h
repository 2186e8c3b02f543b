#pragma once
// Runs `lpv` on scenes made in memory, with light or blockers that a test writes itself.

#include "lpv/grid.h"
#include "support/made_scenes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace bounce {

using LpvSets = std::vector<std::pair<std::string, std::string>>;

class LpvTest : public SceneGraphTest {
  protected:
    struct Changes {
        std::string resources, passes, removed; ///< members of a graph that extends `lpv`
        std::string base = "lpv";
    };
    SceneRunner& make(Scene scene, std::vector<Light> lights, const LpvSets& sets, const Changes& changes) {
        LpvSets all{{"shadow_maps.resolution", "64"}, {"rsm.resolution", "64"}};
        all.insert(all.end(), sets.begin(), sets.end());
        std::string file = fmt::format(
            R"("extends":"{}","remove":[{}],"resources":{{{}"rsm.radiance":{{"format":"rgba32f"}},
               "rsm.normal":{{"format":"rgba32f"}},"lpv.irradiance":{{"format":"rgba32f"}},
               "gbuffer.normal":{{"format":"rgba32f"}},"gbuffer.geometric_normal":{{"format":"rgba32f"}}}},"passes":[{}])",
            changes.base, changes.removed, changes.resources, changes.passes);
        run = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(file), all, glm::ivec2(16));
        run->camera.position = {0.9f, 1.1f, 2.4f};
        run->camera.target = {0, 0.4f, 0};
        run->camera.vfov = 1.0f;
        run->frame();
        return *run;
    }
    SceneRunner& make(Scene scene, std::vector<Light> lights, const LpvSets& sets) {
        return make(std::move(scene), std::move(lights), sets, Changes{});
    }
    /// `write` is GLSL: the light of the cell `at` as the value of `vec4 c` (all colours the same).
    SceneRunner& make_with_light(const std::string& write, const LpvSets& sets, Scene scene = blocks()) {
        shader("test/light.comp", R"(#include "lpv/grid.glsl"
#include "lpv/light.glsl"
layout(local_size_x = 64) in;
layout(std430) writeonly buffer lpv_light { mat3x4 light[]; };
layout(std430) writeonly buffer lpv_sum { mat3x4 sums[]; };
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= sums.length()) return;
    ivec3 at = cell_of_index(uint(i % cells_of_cascade()), grid_size());
    vec4 c = vec4(0.0);
    )" + write + R"(
    light[i] = sums[i] = mat3x4(c, c, c);
}
)");
        Changes changes;
        changes.removed = R"("blend","inject")";
        changes.passes = R"({"after":"blocking","id":"inject","type":"compute","shader":"test/light.comp",
            "needs":"lights","dispatch":["lpv.sum.count"]})";
        return make(std::move(scene), {point_light({0.4f, 1.5f, 0.2f}, {3, 4, 5})}, sets, changes);
    }

    LpvGrid grid() const { return run->read_buffer<LpvGrid>("lpv.grid").at(0); }
    int cells() const { return grid().cells; }
    int index(glm::ivec3 at) const { return (at.z * cells() + at.y) * cells() + at.x; }
    /// The light that iteration `count` left (0: what was injected), all cascades.
    std::vector<LpvLight> wave(int count) const {
        std::vector<LpvLight> both = run->read_buffer<LpvLight>("lpv.light");
        const size_t half = both.size() / 2;
        return {both.begin() + std::ptrdiff_t(count % 2 ? half : 0),
                both.begin() + std::ptrdiff_t(count % 2 ? 2 * half : half)};
    }
    /// Flux of all cells of one colour over π.
    static double flux(const std::vector<LpvLight>& light, int colour = 0) {
        double sum = 0;
        for (const LpvLight& cell : light)
            sum += double(cell[colour].x);
        return sum * 2 * std::sqrt(M_PI) / M_PI;
    }

    std::unique_ptr<SceneRunner> run;
};

/// Whether a triangle crosses a stretch: 1, 0, or −1 where rounding may decide.
inline int crosses(const glm::dvec3 (&p)[3], glm::dvec3 from, glm::dvec3 step) {
    const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], h = glm::cross(step, e2);
    const double determinant = glm::dot(e1, h);
    if (std::abs(determinant) < 1e-9) return -1;
    const glm::dvec3 s = from - p[0], q = glm::cross(s, e1);
    const double u = glm::dot(s, h) / determinant, v = glm::dot(step, q) / determinant,
                 t = glm::dot(e2, q) / determinant;
    const double inside = std::min({u, v, 1 - u - v, t, 1 - t});
    return inside > 1e-3 ? 1 : inside < -1e-3 ? 0 : -1;
}

} // namespace bounce
