// The picture is linear in the light, over twelve decades and in every graph: half floats in between do not show.
#include "app/capture.h"
#include "app/session.h"
#include "core/paths.h"
#include "scene/pre_exposure.h"
#include "support/gpu_context.h"
#include "support/shared_scene.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>

using namespace bounce;

namespace {

/// A room with a lamp near its ceiling, an emissive panel and a window; every kind of light that a graph may model.
TinyScene room() {
    TinyScene scene;
    scene.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -3}, {-2, 0, -3}, {0.6f, 0.6f, 0.6f});
    scene.quad({-2, 3, -3}, {2, 3, -3}, {2, 3, 0}, {-2, 3, 0}, {0.6f, 0.6f, 0.6f});
    scene.quad({-2, 0, -3}, {2, 0, -3}, {2, 3, -3}, {-2, 3, -3}, {0.6f, 0.6f, 0.6f});
    scene.quad({-2, 0, 2}, {-2, 0, -3}, {-2, 3, -3}, {-2, 3, 2}, {0.7f, 0.15f, 0.1f});
    scene.quad({2, 0, -3}, {2, 0, 2}, {2, 3, 2}, {2, 3, -3}, {0.15f, 0.6f, 0.2f});
    scene.box({-1, 0.01f, -2}, {-0.2f, 1.2f, -1.2f}, {0.5f, 0.5f, 0.7f});
    scene.quad({1.3f, 0.5f, -2}, {1.3f, 0.5f, -1}, {1.3f, 1.5f, -1}, {1.3f, 1.5f, -2}).emission({0.4f, 0.3f, 0.2f});
    return scene;
}

constexpr const char* k_lamp = R"({"type":"point","position":[0.8,2.7,0.3],"intensity":[3,2.5,2]})";

std::vector<std::string> graph_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "graphs"))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

struct LightOf {
    std::vector<glm::vec3> intensities, emissions;
    glm::vec3 environment;
    explicit LightOf(const Shot& shot) : environment(shot.environment.radiance) {
        for (const Light& light : shot.scene.lights)
            intensities.push_back(light.intensity);
        for (const Material& material : shot.scene.materials)
            emissions.push_back(material.emission);
    }
    void set(Session& session, float scale) const {
        Shot& shot = session.shot();
        for (size_t i = 0; i < intensities.size(); ++i)
            shot.scene.lights[i].intensity = intensities[i] * scale;
        for (size_t i = 0; i < emissions.size(); ++i)
            shot.scene.materials[i].emission = emissions[i] * scale;
        shot.environment.radiance = environment * scale;
        session.scene_edited();
    }
};

class LightRangeTest : public GpuTest {
  protected:
    std::unique_ptr<Session> open(const std::string& shot, const std::string& graph, glm::ivec2 size = {24, 24}) {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = size;
        auto session = std::make_unique<Session>(options);
        const std::vector<std::string> known = session->graph().model().parameter_names();
        const std::pair<const char*, const char*> small[] = {
            {"shadow_maps.resolution", "128"},     {"rsm.resolution", "64"}, {"voxelization.resolution", "32"},
            {"occlusion_voxels.resolution", "32"}, {"ldm.resolution", "32"}, {"ldm.maps", "32"},
            {"lrsm_layers.depth_layers", "2"},     {"vpls.vpls", "256"},     {"splat.points", "2000"}};
        for (const auto& [name, value] : small)
            if (std::find(known.begin(), known.end(), name) != known.end())
                session->set_parameter(name, value, ParameterOrigin::command_line);
        return session;
    }
    static LayeredImage picture(Session& session) {
        session.render(true);
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.where << ": " << problem.error.text();
        return read_parts(session);
    }
    /// Each pixel of each part within `share` of itself and a tenth of that of the mean.
    static void expect_same(const LayeredImage& picture, const LayeredImage& truth, double scale, double share,
                            const std::string& what) {
        ASSERT_EQ(picture.layers.size(), truth.layers.size()) << what;
        for (const auto& [name, image] : truth.layers) {
            const std::vector<float>&a = picture.layers.at(name).pixels, &b = image.pixels;
            ASSERT_EQ(a.size(), b.size());
            const double s = holds_radiance(name) ? scale : 1;
            double mean = 0, worst = 0;
            for (float v : b)
                mean += v / double(b.size());
            for (size_t i = 0; i < b.size(); ++i) {
                ASSERT_TRUE(std::isfinite(a[i])) << what << ": " << name << " at " << i;
                worst = std::max(worst, (std::abs(a[i] / s - b[i])) / (b[i] + 0.1 * mean + 1e-30));
            }
            EXPECT_LT(worst, share) << what << ": " << name << " (mean " << mean << ")";
        }
    }
    std::string shot_of(const std::string& name, const TinyScene& scene, const std::string& lights,
                        const std::string& more = "", float s = 1) {
        scene.write(root.path(), name);
        return write_shot(root.path(), name, name + ".gltf", s * glm::vec3(0.3f, 1.6f, 1.7f),
                          s * glm::vec3(0, 1.1f, -2), lights, more);
    }
    TempRoot root;
};

} // namespace

/// No graph is left out: one that cannot would have to say so here.
TEST_F(LightRangeTest, EveryGraphIsLinearInTheLight) {
    const std::string shot = shot_of("room", room(), k_lamp, R"(,"environment":0.2)");
    for (const std::string& graph : graph_names()) {
        SCOPED_TRACE(graph);
        const auto session_opened = open(shot, graph);
        Session& session = *session_opened;
        const LightOf light(session.shot());
        const LayeredImage truth = picture(session);
        EXPECT_EQ(session.constants().pre_exposure, 1.0f) << "an ordinary scene is stored as it is";
        std::set<float> used;
        for (float scale : {1e-6f, 1e-3f, 1e3f, 1e6f, 1.0f}) {
            light.set(session, scale);
            const LayeredImage seen = picture(session);
            used.insert(session.constants().pre_exposure);
            // Half floats have 11 bits; a gather adds up some of them. The harmonics of `lpv` also subtract: where
            // lobes nearly cancel, the maps' rounding is a larger share of what is left.
            const double share = graph == "lpv" ? 8e-3 : 4e-3;
            expect_same(seen, truth, scale, scale == 1 ? 1e-6 : share, graph + " at " + std::to_string(scale));
        }
        EXPECT_GE(used.size(), 4u) << "it was not tried";
    }
}

/// With glossy surfaces, in the graphs that know them.
TEST_F(LightRangeTest, GlossIsLinearInTheLight) {
    const std::string shot = shot_of("room", room(), k_lamp);
    for (const char* graph : {"direct", "dvs_tuned", "lrsm_tuned"}) {
        const auto session_opened = open(shot, graph);
        Session& session = *session_opened;
        session.shot().diffuse_only = false;
        for (Material& material : session.shot().scene.materials)
            material.roughness = 0.6f;
        session.scene_edited();
        const LightOf light(session.shot());
        const LayeredImage truth = picture(session);
        for (float scale : {1e-6f, 1e6f}) {
            light.set(session, scale);
            expect_same(picture(session), truth, scale, 4e-3, graph);
        }
    }
}

/// The same room in millimetres, in kilometres: positions × s, intensities × s².
TEST_F(LightRangeTest, EveryGraphIsTheSameAtEverySize) {
    const std::string metres = shot_of("metres", room(), k_lamp);
    for (const std::string& graph : graph_names()) {
        const auto session_opened = open(metres, graph);
        Session& session = *session_opened;
        const LayeredImage truth = picture(session);
        for (float s : {0x1p-10f, 0x1p10f}) {
            const std::string lamp =
                fmt::format(R"({{"type":"point","position":{},"intensity":{}}})",
                            json_of(s * glm::vec3(0.8f, 2.7f, 0.3f)), json_of(s * s * glm::vec3(3, 2.5f, 2)));
            const auto other_opened = open(shot_of("other", room().scaled(s), lamp, "", s), graph);
            Session& other = *other_opened;
            // By a power of two nothing is rounded otherwise, but where a graph adds a length of its own.
            expect_same(picture(other), truth, 1, 4e-3, graph + " at size " + std::to_string(s));
        }
    }
}

TEST_F(LightRangeTest, TheCaseInMillimetres) {
    const std::filesystem::path folder = shared_scene("../cases/half_range");
    if (folder.empty()) GTEST_SKIP() << "the test scenes are not there";
    for (const std::string& graph : graph_names()) {
        const auto metres_opened = open((folder / "metres.json").string(), graph, {32, 32});
        Session& metres = *metres_opened;
        const auto millimetres_opened = open((folder / "millimetres.json").string(), graph, {32, 32});
        Session& millimetres = *millimetres_opened;
        const LayeredImage truth = picture(metres);
        // The lamp is the same, a thousand times as far away: a millionth of the light. Then a million of lamps.
        const LightOf lamp(millimetres.shot());
        for (float lamps : {1.0f, 1e6f}) {
            lamp.set(millimetres, lamps);
            const LayeredImage seen = picture(millimetres);
            for (const auto& [name, image] : truth.layers) {
                double a = 0, b = 0;
                for (size_t i = 0; i < image.pixels.size(); ++i)
                    a += seen.layers.at(name).pixels[i], b += image.pixels[i];
                const double wanted = holds_radiance(name) ? 1e-6 * lamps : 1;
                if (b > 0) {
                    EXPECT_NEAR(a / b / wanted, 1, 0.005) << graph << ": " << name << ", " << lamps << " lamps";
                }
            }
        }
    }
}

TEST_F(LightRangeTest, OnlyEmissionOrOnlyTheEnvironment) {
    const std::string shot = shot_of("room", room(), "", R"(,"environment":0.2)");
    for (const char* graph : {"direct", "dvs", "dvs_tuned", "vct_tuned", "ldm_environment"}) {
        const auto session_opened = open(shot, graph);
        Session& session = *session_opened;
        const LightOf light(session.shot());
        for (bool emission : {true, false}) {
            LightOf one = light;
            if (emission)
                one.environment = glm::vec3(0);
            else
                std::fill(one.emissions.begin(), one.emissions.end(), glm::vec3(0));
            one.set(session, 1);
            const LayeredImage truth = picture(session);
            for (float scale : {1e-6f, 1e6f}) {
                one.set(session, scale);
                expect_same(picture(session), truth, scale, 4e-3, graph);
            }
        }
    }
}

/// A bright lamp in one room and one of a hundred-thousandth in the next: the dim one keeps its bits.
TEST_F(LightRangeTest, ADimLightBesideABrightOne) {
    TinyScene rooms;
    rooms.quad({-2, 0, 1}, {2, 0, 1}, {2, 0, -1}, {-2, 0, -1});
    rooms.quad({0, 0, 1}, {0, 0, -1}, {0, 2, -1}, {0, 2, 1});
    const std::string dim = R"({"type":"point","position":[1,1,0],"intensity":0.1})";
    auto shot = [&](const std::string& name, const std::string& lights) {
        rooms.write(root.path(), name);
        return write_shot(root.path(), name, name + ".gltf", {1, 1.5f, 0.6f}, {1, 0, 0}, lights);
    };
    const auto alone_opened = open(shot("alone", dim), "direct");
    Session& alone = *alone_opened;
    const auto both_opened =
        open(shot("both", dim + R"(,{"type":"point","position":[-1,1,0],"intensity":10000})"), "direct");
    Session& both = *both_opened;
    const LayeredImage truth = picture(alone), seen = picture(both);
    EXPECT_NE(both.constants().pre_exposure, 1.0f);
    // Shadow maps decide by texels at the wall's foot: the middle of the floor is looked at.
    for (int y = 10; y < 14; ++y)
        for (int x = 10; x < 14; ++x) {
            const float wanted = truth.layers.at("out.direct").at(x, y)[0];
            EXPECT_GT(wanted, 0.001f);
            EXPECT_NEAR(seen.layers.at("out.direct").at(x, y)[0] / wanted, 1, 0.01) << x << ", " << y;
        }
}

/// What people see of textures is in the file's units: captures of any resource, the display.
TEST_F(LightRangeTest, WhatIsShownIsUnscaled) {
    const std::string shot = shot_of("room", room(), k_lamp, R"(,"environment":0.2)");
    const auto session_opened = open(shot, "dvs");
    Session& session = *session_opened;
    const LightOf light(session.shot());
    std::map<std::string, Image> before;
    auto take = [&](const std::string& resource) {
        return read_layer(*session.graph().texture(resource), 0, 0, session.value_scale(resource));
    };
    const char* const resources[] = {"out.radiance",    "gbuffer.emission", "dvs.radiance",  "dvs.bounced",
                                     "dvs.directional", "voxels.emission",  "gbuffer.albedo"};
    picture(session);
    for (const char* resource : resources)
        before[resource] = take(resource);
    light.set(session, 0x1p20f);
    picture(session);
    for (const char* resource : resources) {
        const Image now = take(resource);
        const float scale = std::string(resource) == "gbuffer.albedo" ? 1 : 0x1p20f;
        const int channels = now.channels;
        double worst = 0, most = 0;
        for (size_t i = 0; i < now.pixels.size(); ++i) {
            const float s = int(i) % channels < 3 ? scale : 1; // the fourth is an opacity
            worst = std::max(worst, double(std::abs(now.pixels[i] / s - before[resource].pixels[i])));
            most = std::max(most, double(std::abs(before[resource].pixels[i])));
        }
        EXPECT_LT(worst, 4e-3 * most) << resource;
        EXPECT_GT(most, 0) << resource;
    }
    // Twenty stops brighter, and an exposure of −16 and a scene of 2⁻⁴: the display is the same.
    light.set(session, 1);
    session.render(true);
    const Image display = read_layer(*session.graph().texture("out.display"));
    light.set(session, 0x1p16f);
    session.set_parameter("tonemap.exposure", "-16", ParameterOrigin::command_line);
    session.render(true);
    const Image bright = read_layer(*session.graph().texture("out.display"));
    for (size_t i = 0; i < display.pixels.size(); ++i)
        ASSERT_NEAR(display.pixels[i], bright.pixels[i], 1.01f / 255);
}

TEST(PreExposure, IsAPowerOfTwoThatFollowsTheLightAndNothingElse) {
    SceneState state;
    state.lights.emplace_back().intensity = glm::vec3(1);
    const auto of = [&](float intensity, float diagonal) {
        state.lights[0].intensity = glm::vec3(intensity);
        return pre_exposure(state, {}, {}, diagonal);
    };
    EXPECT_EQ(of(1, 7), 1);
    for (float intensity : {1e-30f, 1e-6f, 1e6f, 1e30f}) {
        const float s = of(intensity, 7);
        EXPECT_EQ(std::exp2(std::round(std::log2(s))), s);
        // The brightest likely radiance comes to 2^10: I/(π·(diagonal/100)²).
        EXPECT_NEAR(std::log2(s * intensity / (3.14159265 * 0.07 * 0.07)), 10, 0.51) << intensity;
        EXPECT_EQ(of(4 * intensity, 14), s) << "twice as large, with lamps to match";
        state.lights[0].position = glm::vec3(3, 2, 1);
        EXPECT_EQ(of(intensity, 7), s);
    }
    EXPECT_EQ(of(0, 7), 1);
    EXPECT_EQ(pre_exposure({}, {}, {}, 0), 1);
}
