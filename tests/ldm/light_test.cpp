// What is made of layered depth maps, against closed forms: ambient occlusion, obscurance, environment light, gloss
// along the nearest axis, accumulation over frames, and the half-resolution picture.
#include "ldm/directions.h"
#include "support/scene_runner.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace bounce {
namespace {

constexpr const char* k_loop = R"("repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"})";

std::string graph_text() {
    std::string loop = k_loop;
    return R"("parameters": {"scale": {"default": 1.0, "range": [0.125, 1]}},
    "resources": {"ldm.openness": {"format": "rg32f", "clear": false, "size": ["width * graph.scale", "height * graph.scale"]},
                  "ldm.sky": {"format": "rgba32f", "clear": false}, "out.environment": {"format": "rgba32f"},
                  "out.indirect_specular": {"format": "rgba32f"},
                  "accumulate.mean": {"format": "rgba32f", "persistent": true, "size": "ldm.openness"},
                  "out.ambient_occlusion": {"format": "r32f"}, "out.ambient_occlusion_dmax": {"format": "r32f"}},
    "passes": [ {"type": "gbuffer"}, {"type": "rsm", "params": {"resolution": 64}},
        {"type": "ldm", "params": {"maps": 128, "resolution": 64, "tilted": true, "nodes": "plane"}},
        {"id": "ambient_occlusion", "type": "compute", "shader": "ldm/ambient_occlusion.comp",
         "params": {"own_surface": "nearest", "node_planes": true}, )" +
           loop + R"(},
        {"id": "environment", "type": "compute", "shader": "ldm/environment.comp", "params_of": "ambient_occlusion",
         "needs": "environment", )" +
           loop + R"(},
        {"id": "gloss", "type": "compute", "shader": "ldm/gloss.comp", "params_of": "ambient_occlusion",
         "needs": "glossy_materials * spot_lights", )" +
           loop + R"(},
        {"id": "accumulate", "type": "compute", "shader": "surface/accumulate.comp", "enabled": false,
         "bind": {"accumulate.picture": "ldm.openness"}},
        {"id": "finish", "type": "compute", "shader": "ldm/finish_ambient_occlusion.comp",
         "dispatch": "out.ambient_occlusion"},
        {"id": "shade_environment", "type": "compute", "shader": "surface/shade_diffuse.comp", "needs": "environment",
         "bind": {"gathered.irradiance": "ldm.sky", "out.indirect_diffuse": "out.environment"}} ])";
}

class LdmLight : public SceneGraphTest {
  protected:
    std::unique_ptr<SceneRunner> runner(Scene scene, Camera camera,
                                        const std::vector<std::pair<std::string, std::string>>& sets = {},
                                        std::vector<Light> lights = {}) {
        auto made = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(graph_text()), sets,
                                                  glm::ivec2(32, 32));
        made->camera = camera;
        return made;
    }
    static double mean(const std::vector<float>& values, int channels = 1) {
        double sum = 0;
        for (size_t i = 0; i < values.size(); i += size_t(channels))
            sum += double(values[i]);
        return sum / double(values.size() / size_t(channels));
    }
};

Camera at(glm::vec3 position, glm::vec3 target, float degrees = 20) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    camera.up = std::abs(glm::normalize(target - position).y) > 0.9f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    camera.vfov = glm::radians(degrees);
    return camera;
}

Scene floor_and_ceiling(float height, glm::vec3 colour = {0.5f, 0.6f, 0.7f}) {
    return MadeScene()
        .quad({-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50}, colour)
        .quad({-50, height, -50}, {50, height, -50}, {50, height, 50}, {-50, height, 50})
        .scene;
}

// Nothing above a plane: 1. The axes' quadrature of the cosine is all that may be off.
TEST_F(LdmLight, AnOpenPlaneIsOpen) {
    auto r =
        runner(MadeScene().quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}).scene, at({0, 3, 0.1f}, {0, 0, 0}));
    r->frame();
    double quadrature = 0;
    for (glm::vec3 axis : ldm_directions(128))
        quadrature += 2.0 / 128 * std::abs(double((tilt_off_axes() * axis).y));
    EXPECT_NEAR(quadrature, 1, 0.01);
    for (float v : r->read("out.ambient_occlusion"))
        EXPECT_NEAR(double(v), quadrature, 1e-4);
}

TEST_F(LdmLight, AClosedBoxIsShut) {
    auto r =
        runner(MadeScene().box({-1, -1, -1}, {1, 1, 1}, glm::vec3(0.5f), true).scene, at({0, 0, 0.5f}, {0, 0, -1}, 60));
    r->frame();
    // Leaks would show as light: rays near edges whose own texel holds no node of theirs may pass.
    EXPECT_LT(mean(r->read("out.ambient_occlusion")), 0.005);
}

// A wall of infinite height closes half of the sky at its foot: 1/2; at distance s from a wall of height h,
// 1 − ½(1 − s/√(s² + h²)).
TEST_F(LdmLight, BesideAWall) {
    for (float s : {0.25f, 1.0f, 2.0f}) {
        Scene scene = MadeScene()
                          .quad({-60, 0, 6}, {60, 0, 6}, {60, 0, 0}, {-60, 0, 0})
                          .quad({-60, 0, 0}, {60, 0, 0}, {60, 2, 0}, {-60, 2, 0})
                          .scene;
        auto r = runner(std::move(scene), at({0, 5, s + 3}, {0, 0, s}, 0.5f),
                        {{"ldm.resolution", "256"}, {"ldm.maps", "256"}, {"ldm.memory", "4096"}});
        r->frame();
        double expected = 1 - 0.5 * (1 - s / std::sqrt(s * s + 4));
        EXPECT_NEAR(mean(r->read("out.ambient_occlusion")), expected, 0.03) << s;
    }
}

// Under a wide ceiling at height h, r = h/cosθ: with c = h/d_max, occluders within d_max leave c² open, and as
// obscurance ∫ (r/d_max)²·2cosθ dcosθ over cosθ > c adds 2c²·ln(1/c).
TEST_F(LdmLight, ObscuranceUnderACeiling) {
    for (const char* falloff : {"none", "quadratic"}) {
        auto r =
            runner(floor_and_ceiling(1), at({0, 0.9f, 0.05f}, {0, 0, 0}), {{"ambient_occlusion.falloff", falloff}});
        double d_max = 2, c = 1 / d_max;
        r->set("ambient_occlusion.d_max", std::to_string(d_max / r->facts.bounds_over_animation.diagonal()));
        r->frame();
        double expected = c * c + (falloff[0] == 'q' ? 2 * c * c * std::log(1 / c) : 0);
        // 128 axes sample the step at cosθ = c in rings.
        EXPECT_NEAR(mean(r->read("out.ambient_occlusion_dmax")), expected, 0.02) << falloff;
    }
}

// A constant sky: what arrives is ρ·L times what is open, by the same axes.
TEST_F(LdmLight, AConstantSkyIsAmbientOcclusion) {
    glm::vec3 colour(0.5f, 0.6f, 0.7f), sky(2, 3, 4);
    auto r = runner(MadeScene()
                        .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, colour)
                        .box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}, colour)
                        .scene,
                    at({1, 4, 3}, {0, 0.3f, 0}, 40));
    r->set_environment(sky);
    r->frame();
    std::vector<float> open = r->read("out.ambient_occlusion"), light = r->read("out.environment"),
                       depth = r->read("gbuffer.depth");
    int compared = 0;
    for (size_t i = 0; i < open.size(); ++i) {
        if (depth[i] <= 0) continue;
        ++compared;
        for (int channel = 0; channel < 3; ++channel) {
            double expected = double(colour[channel]) * double(sky[channel]) * double(open[i]);
            EXPECT_NEAR(double(light[4 * i + size_t(channel)]), expected, 2e-3 * expected + 1e-6);
        }
    }
    EXPECT_GT(compared, 500);
}

// A mirror shows the lit wall behind the viewer: what the wall sends on, times the lobe's albedo (1 for a white metal).
TEST_F(LdmLight, AMirrorShowsWhatTheLightMapsHold) {
    MadeScene made;
    made.quad({-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}, {1, 1, 1});
    made.material().metallic = 1;
    made.material().roughness = 0;
    made.quad({-6, -6, 4}, {-6, 6, 4}, {6, 6, 4}, {6, -6, 4}, {0.5f, 0.5f, 0.5f});
    auto r = runner(made.scene, at({0, 0, 3}, {0, 0, -2}, 15), {{"ldm.maps", "512"}, {"ldm.memory", "1024"}},
                    {spot_light({0, 0, -1}, {0, 0, 1}, {50, 50, 50}, 44, 45)});
    r->diffuse_only = 0;
    r->facts.glossy_materials = 1;
    r->frame();
    // In the middle: E = I/d² = 50/25, and ρE/π leaves the wall.
    std::vector<float> mirror = r->read("out.indirect_specular");
    double expected = 0.5 * 2 / std::numbers::pi, middle = double(mirror[4 * (16 * 32 + 16)]);
    // The nearest axis lies some degrees beside the mirror direction, where the light falls off a little.
    EXPECT_NEAR(middle / expected, 1, 0.1);
}

// Axes that turn from frame to frame: the mean over 16 frames of 16 maps is nearer the truth than one frame, and a
// camera that moves starts it anew.
TEST_F(LdmLight, AccumulationNearsTheTruth) {
    auto scene = [] {
        return MadeScene()
            .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2})
            .box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f})
            .scene;
    };
    Camera camera = at({1, 4, 3}, {0, 0.3f, 0}, 40);
    auto truth = runner(scene(), camera, {{"ldm.maps", "512"}, {"ldm.memory", "1024"}});
    truth->frame();
    auto turning = runner(scene(), camera, {{"ldm.maps", "16"}, {"ldm.rotate", "true"}});
    turning->graph.model().switch_pass("accumulate", true);
    std::vector<float> exact = truth->read("out.ambient_occlusion");
    auto error = [&] {
        double sum = 0;
        std::vector<float> values = turning->read("out.ambient_occlusion");
        for (size_t i = 0; i < values.size(); ++i)
            sum += std::pow(double(values[i]) - double(exact[i]), 2);
        return std::sqrt(sum / double(values.size()));
    };
    turning->frame();
    double first = error();
    for (int i = 1; i < 16; ++i)
        turning->frame();
    double last = error();
    EXPECT_LT(last, 0.35 * first);
    EXPECT_EQ(turning->read("accumulate.mean")[3], 16.0f);
    turning->camera.position.x += 0.01f;
    turning->frame();
    EXPECT_EQ(turning->read("accumulate.mean")[3], 1.0f);
}

TEST_F(LdmLight, HalfResolutionIsNear) {
    Scene scene =
        MadeScene().quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}).box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}).scene;
    auto r = runner(std::move(scene), at({1, 4, 3}, {0, 0.3f, 0}, 40));
    r->frame();
    std::vector<float> full = r->read("out.ambient_occlusion");
    r->set("graph.scale", "0.5");
    r->frame();
    std::vector<float> half = r->read("out.ambient_occlusion");
    EXPECT_EQ(r->texture("ldm.openness").desc().size.x, 16);
    double sum = 0;
    for (size_t i = 0; i < full.size(); ++i)
        sum += std::abs(double(full[i]) - double(half[i]));
    EXPECT_LT(sum / double(full.size()), 0.03); // edges at 32 × 32
}

} // namespace
} // namespace bounce
