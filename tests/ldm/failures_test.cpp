// What the LDM paper says its methods fail at, measured: footprints that blur indirect shadows, bands from few
// directions, flicker when the views turn, a surface that meets itself, grazing surfaces. The figures are properties of
// the tests.
#include "ldm/directions.h"
#include "ldm/photons.h"
#include "support/scene_runner.h"

#include <cmath>
#include <gtest/gtest.h>

namespace bounce {
namespace {

constexpr const char* k_ambient_occlusion = R"(
    "resources": {"ldm.openness": {"format": "rg32f", "clear": false},
                  "out.ambient_occlusion": {"format": "r32f"}, "out.ambient_occlusion_dmax": {"format": "r32f"}},
    "passes": [ {"type": "gbuffer"}, {"type": "ldm", "params": {"maps": 64, "resolution": 64}},
        {"id": "ambient_occlusion", "type": "compute", "shader": "ldm/ambient_occlusion.comp",
         "repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"}},
        {"id": "finish", "type": "compute", "shader": "ldm/finish_ambient_occlusion.comp",
         "dispatch": "out.ambient_occlusion"} ])";

constexpr const char* k_photons = R"(
    "passes": [ {"type": "gbuffer"}, {"type": "rsm", "params": {"resolution": 16}},
        {"type": "ldm", "params": {"maps": 256, "resolution": 64, "tilted": true, "memory": 1024}},
        {"type": "photons", "params": {"own_surface": "nearest", "exact_split": true, "visibility": "plane", "snap": true,
                                       "footprint_excess": "shrink", "footprint_scale": 8},
         "bind": {"prefix.values": "photons.places", "prefix.sums": "photons.place_sums"},
         "repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"}},
        {"type": "splat", "repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"}} ])";

class LdmFailures : public SceneGraphTest {
  protected:
    std::unique_ptr<SceneRunner> run(Scene scene, Camera camera, const char* graph,
                                     const std::vector<std::pair<std::string, std::string>>& sets,
                                     glm::ivec2 size = {48, 32}, std::vector<Light> lights = {}) {
        auto r = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(graph), sets, size);
        r->camera = camera;
        do {
            r->frame();
        } while (r->graph.needs_larger_buffers());
        return r;
    }
    void note(const std::string& what, double value) { RecordProperty(what, std::to_string(value)); }
};

Camera at(glm::vec3 position, glm::vec3 target, float degrees) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    camera.vfov = glm::radians(degrees);
    return camera;
}

// A lit patch of floor, a wall, and between them a plate that shades the wall's left half from the patch. Footprints of
// few, wide photons reach across the shadow's edge; a limit on them takes that back.
TEST_F(LdmFailures, WideFootprintsBlurIndirectShadows) {
    auto scene = [] {
        return MadeScene()
            .quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}, {0.8f, 0.8f, 0.8f})
            .quad({-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3}, {0.8f, 0.8f, 0.8f})
            .quad({-3, 0, -1}, {0, 0, -1}, {0, 3, -1}, {-3, 3, -1}, {0.8f, 0.8f, 0.8f})
            .scene;
    };
    std::vector<Light> lights = {spot_light({0.3f, 2.5f, 1}, {0, -1, 0}, {30, 30, 30}, 11, 12)};
    // Seen from the right, past the plate's edge: the wall's left part lies behind the plate. x < −0.9 is in the umbra
    // (the patch is a disc of radius 0.53 about x = 0.3, z = 1: its last rays past the plate's edge meet the wall at x
    // ≈ −0.86).
    Camera camera = at({2.8f, 1.5f, -1.6f}, {-1, 1.2f, -3}, 60);
    auto leak = [&](const char* limit) {
        auto r = run(scene(), camera, k_photons, {{"photons.footprint_limit", limit}}, {48, 32}, lights);
        std::vector<float> light = r->read("photons.irradiance"), depth = r->read("gbuffer.depth");
        std::vector<Photon> photons = r->read_buffer<Photon>("photons.stored");
        photons.resize(r->read_buffer<uint32_t>("photons.commands").at(7));
        // The share of the flux whose footprints reach into the umbra, by how much of their length lies in it.
        double inside = 0, all = 0;
        for (const Photon& p : photons) {
            if (std::abs(p.position.z + 3) > 2e-3f) continue;
            double half = 0.5 * (std::abs(double(p.du.x)) + std::abs(double(p.dv.x)));
            double low = double(p.position.x) - half;
            all += double(p.flux.g);
            if (low < -0.9) inside += double(p.flux.g) * std::min(1.0, (-0.9 - low) / (2 * half + 1e-9));
        }
        return inside / all;
    };
    double wide = leak("1"), middle = leak("0.06"), narrow = leak("0.02");
    note("flux_in_the_umbra_without_a_limit", wide);
    note("flux_in_the_umbra_limit_0.06", middle);
    note("flux_in_the_umbra_limit_0.02", narrow);
    EXPECT_GT(wide, middle);
    EXPECT_GT(middle, narrow);
    EXPECT_LT(narrow, 0.5 * wide);
}

// Beside a wall the truth is smooth along the floor; few axes leave steps where each of them just misses the wall's
// top.
TEST_F(LdmFailures, FewDirectionsBand) {
    Scene scene;
    auto roughness = [&](const char* maps) {
        Scene made = MadeScene()
                         .quad({-4, 0, 4}, {4, 0, 4}, {4, 0, 0}, {-4, 0, 0})
                         .quad({-4, 0, 0}, {4, 0, 0}, {4, 1.5f, 0}, {-4, 1.5f, 0})
                         .scene;
        auto r = run(std::move(made), at({0, 6, 1.5f}, {0, 0, 1.49f}, 18), k_ambient_occlusion,
                     {{"ldm.maps", maps},
                      {"ldm.resolution", "128"},
                      {"ldm.memory", "1024"},
                      {"ldm.tilted", "true"},
                      {"ambient_occlusion.own_surface", "nearest"}},
                     {8, 64});
        std::vector<float> open = r->read("out.ambient_occlusion");
        double sum = 0;
        for (size_t y = 1; y + 1 < 64; ++y)
            sum += std::pow(double(open[(y - 1) * 8 + 4]) - 2 * double(open[y * 8 + 4]) + double(open[(y + 1) * 8 + 4]),
                            2);
        return std::sqrt(sum / 62);
    };
    double few = roughness("16"), some = roughness("64"), many = roughness("256");
    note("second_difference_16_maps", few);
    note("second_difference_64_maps", some);
    note("second_difference_256_maps", many);
    EXPECT_GT(few, some);
    EXPECT_GT(some, many);
    EXPECT_LT(many, 0.35 * few);
}

// Views that turn each frame flicker; those that stay give the same bytes.
TEST_F(LdmFailures, TurningViewsFlicker) {
    auto flicker = [&](const char* maps, const char* rotate) {
        Scene made = MadeScene()
                         .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2})
                         .box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f})
                         .scene;
        auto r =
            run(std::move(made), at({1, 4, 3}, {0, 0.3f, 0}, 40), k_ambient_occlusion,
                {{"ldm.maps", maps}, {"ldm.rotate", rotate}, {"ambient_occlusion.own_surface", "nearest"}}, {32, 24});
        std::vector<float> last = r->read("out.ambient_occlusion");
        double sum = 0;
        for (int i = 0; i < 6; ++i) {
            r->frame();
            std::vector<float> now = r->read("out.ambient_occlusion");
            for (size_t p = 0; p < now.size(); ++p)
                sum += std::pow(double(now[p]) - double(last[p]), 2) / (6.0 * double(now.size()));
            last = now;
        }
        return std::sqrt(sum);
    };
    EXPECT_EQ(flicker("64", "false"), 0);
    double few = flicker("16", "true"), many = flicker("128", "true");
    note("flicker_16_maps", few);
    note("flicker_128_maps", many);
    EXPECT_GT(few, 3 * many);
    EXPECT_GT(many, 0);
}

// An open plane that is turned against the axes must stay open. Depths of texels' middles lie before or behind a
// grazing surface's own points by more than any tolerance; the nearest node, or the node's plane, is right at every
// angle.
TEST_F(LdmFailures, SurfacesMeetThemselves) {
    auto error = [&](const std::vector<std::pair<std::string, std::string>>& sets) {
        double worst = 0;
        for (float degrees : {0.0f, 17.0f, 33.0f, 45.0f}) {
            glm::vec3 u(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)), 0), v(0, 0, -1);
            glm::vec3 n = glm::cross(u, v);
            Scene made = MadeScene().quad(-u - v, u - v, u + v, -u + v).scene;
            auto r = run(std::move(made), at(3.0f * n + glm::vec3(0, 0, 0.1f), {0, 0, 0}, 25), k_ambient_occlusion,
                         sets, {16, 16});
            double quadrature = 0, sum = 0;
            for (glm::vec3 axis : ldm_directions(64))
                quadrature += 2.0 / 64 * std::abs(double(glm::dot(axis, n)));
            std::vector<float> open = r->read("out.ambient_occlusion");
            for (float o : open)
                sum += double(o);
            worst = std::max(worst, std::abs(sum / double(open.size()) - quadrature));
        }
        return worst;
    };
    double tight = error({{"ambient_occlusion.tolerance", "0.05"}}),
           usual = error({{"ambient_occlusion.tolerance", "0.5"}});
    double loose = error({{"ambient_occlusion.tolerance", "4"}});
    double nearest = error({{"ambient_occlusion.own_surface", "nearest"}});
    double planes = error(
        {{"ambient_occlusion.tolerance", "0.05"}, {"ldm.nodes", "plane"}, {"ambient_occlusion.node_planes", "true"}});
    note("self_occlusion_tolerance_0.05", tight);
    note("self_occlusion_tolerance_0.5", usual);
    note("self_occlusion_tolerance_4", loose);
    note("self_occlusion_nearest", nearest);
    note("self_occlusion_planes", planes);
    EXPECT_GT(tight, usual);
    EXPECT_GT(usual, loose);
    EXPECT_LT(nearest, 1e-4); // a single surface: it is always the nearest
    EXPECT_LT(planes, 0.01);
}

} // namespace
} // namespace bounce
