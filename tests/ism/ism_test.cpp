// Imperfect shadow maps: the lights that are drawn against sums over the reflective shadow maps, the maps against rays
// to the scene's triangles, the gather against a sum over the lights.
#include "ism/vpl.h"
#include "lrsm/rsm_fixture.h"
#include "support/start_points.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

using namespace bounce;

namespace {

using Sets = std::vector<std::pair<std::string, std::string>>;
constexpr int k_side = 64; ///< texels of a map

/// A room, open to one side, with a slab that floats in it.
Scene room_with_slab() {
    return MadeScene()
        .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, {0.8f, 0.4f, 0.2f})
        .quad({-2, 2.5f, -2}, {2, 2.5f, -2}, {2, 2.5f, 2}, {-2, 2.5f, 2})
        .quad({-2, 0, -2}, {2, 0, -2}, {2, 2.5f, -2}, {-2, 2.5f, -2})
        .box({-0.7f, 1.0f, -0.6f}, {0.5f, 1.1f, 0.6f}, {0.2f, 0.6f, 0.4f})
        .scene;
}
std::vector<Light> lamp() {
    return {spot_light({1.2f, 2.4f, 0.9f}, {-0.4f, -1, -0.4f}, {9, 6, 3}, 35, 60)};
}

class Ism : public SceneGraphTest {
  protected:
    void make(const std::string& base, Sets sets, glm::vec3 light = glm::vec3(1)) {
        shader("test/start.comp", k_start_shader);
        shader("test/distances.comp", R"(layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D ism_atlas;
layout(FORMAT_test_distances) writeonly uniform image2D test_distances;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(test_distances)))) return;
    uint bits = texelFetch(ism_atlas, at, 0).r;
    imageStore(test_distances, at, vec4(bits == 0u ? 0.0 : 1.0 / uintBitsToFloat(bits)));
}
)");
        Sets all{{"shadow_maps.resolution", "64"}, {"rsm.resolution", "64"},
                 {"points.proxies", "24000"},      {"vpls.vpls", "16"},
                 {"splat.points", "12000"},        {"graph.scale", "1"}};
        all.insert(all.end(), sets.begin(), sets.end());
        std::vector<Light> lights = lamp();
        lights[0].intensity *= light;
        run = std::make_unique<SceneRunner>(room_with_slab(), lights,
                                            graph_file(fmt::format(R"("extends":"{}",
            "resources":{{"ism.irradiance":{{"format":"rgba32f"}},"gbuffer.normal":{{"format":"rgba32f"}},
                          "rsm.normal":{{"format":"rgba32f"}},"test.start":{{"format":"rgba32f"}},
                          "test.distances":{{"format":"rgba32f","size":"ism.atlas"}}}},
            "passes":[{{"id":"start","type":"compute","shader":"test/start.comp"}},
                      {{"id":"distances","type":"compute","shader":"test/distances.comp"}}])",
                                                                   base)),
                                            all, glm::ivec2(16));
        run->camera.position = {0.2f, 1.3f, 4.5f};
        run->camera.target = {0, 1.2f, 0};
        run->camera.vfov = 0.8f;
        run->frame();
    }
    std::vector<Vpl> vpls() const { return run->read_buffer<Vpl>("ism.vpls"); }

    /// Metres to the first triangle, or 0.
    double traced(glm::dvec3 origin, glm::dvec3 direction) const {
        const Scene& scene = run->scene;
        double nearest = 0;
        for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
            auto corner = [&](size_t k) { return glm::dvec3(scene.vertices[scene.indices[i + k]].position); };
            glm::dvec3 a = corner(0), e1 = corner(1) - a, e2 = corner(2) - a, p = glm::cross(direction, e2);
            double determinant = glm::dot(e1, p);
            if (std::abs(determinant) < 1e-12) continue;
            glm::dvec3 s = origin - a, q = glm::cross(s, e1);
            double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
            double t = glm::dot(e2, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && t > 1e-4 && (nearest == 0 || t < nearest)) nearest = t;
        }
        return nearest;
    }
    /// A frame around n, as in glsl/ism/vpl.glsl.
    static glm::dmat3 frame(glm::dvec3 n) {
        double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), b = n.x * n.y * a;
        return {{1 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}, n};
    }
    struct Compared {
        int texels = 0, wrong = 0, holes = 0;
        double wrong_share() const { return double(wrong) / std::max(texels, 1); }
    };
    /// Of all maps, what lies off silhouettes and not in the outermost tenth, where maps see along surfaces.
    Compared compare_with_rays() const {
        std::vector<float> distances = run->read("test.distances");
        const int atlas = run->texture("ism.atlas").desc().size.x, across = atlas / k_side;
        Compared result;
        const std::vector<Vpl> all = vpls();
        for (size_t v = 0; v < all.size(); ++v) {
            if (all[v].area <= 0) continue;
            glm::dmat3 axes = frame(glm::dvec3(all[v].normal));
            std::vector<double> truth(k_side * k_side, -1);
            for (int i = 0; i < k_side * k_side; ++i) {
                glm::dvec2 p = (glm::dvec2(i % k_side, i / k_side) + 0.5) * 2.0 / double(k_side) - 1.0;
                double squared = glm::dot(p, p);
                if (squared > 0.8) continue;
                glm::dvec3 ray = axes * (glm::dvec3(2.0 * p, 1 - squared) / (1 + squared));
                truth[size_t(i)] = traced(all[v].position, ray);
            }
            for (int y = 2; y < k_side - 2; ++y)
                for (int x = 2; x < k_side - 2; ++x) {
                    double own = truth[size_t(y * k_side + x)];
                    bool plain = own > 0;
                    for (int k = 0; k < 25 && plain; ++k) {
                        double other = truth[size_t((y + k / 5 - 2) * k_side + x + k % 5 - 2)];
                        plain = other > 0 && std::abs(other - own) < 0.25 * own;
                    }
                    if (!plain) continue;
                    int column = int(v) % across * k_side + x, row = int(v) / across * k_side + y;
                    double seen = distances[4 * size_t(row * atlas + column)];
                    ++result.texels;
                    if (seen == 0)
                        ++result.holes;
                    else if (std::abs(seen - own) > 0.05 * own + 0.05)
                        ++result.wrong;
                }
        }
        return result;
    }
    std::unique_ptr<SceneRunner> run;
};

/// E/π at every pixel by a sum over lights without visibility; `closest`: metres.
std::vector<double> sum_over_lights(const SceneRunner& run, double closest) {
    std::vector<float> start = run.read("test.start"), normal = run.read("gbuffer.normal");
    std::vector<double> sums(start.size() / 4, -1);
    const std::vector<Vpl> lights = run.read_buffer<Vpl>("ism.vpls");
    for (size_t i = 0; i < sums.size(); ++i) {
        if (start[4 * i + 3] == 0) continue;
        glm::dvec3 n = glm::normalize(glm::dvec3(ReflectiveShadowMaps::four(normal, i)));
        double sum = 0;
        for (const Vpl& vpl : lights) {
            glm::dvec3 to = glm::dvec3(vpl.position) - glm::dvec3(ReflectiveShadowMaps::four(start, i));
            double squared = glm::dot(to, to);
            double cosines = std::max(glm::dot(n, to), 0.0) * std::max(-glm::dot(glm::dvec3(vpl.normal), to), 0.0);
            if (cosines > 0) sum += double(vpl.intensity.g) * cosines / squared / std::max(squared, closest * closest);
        }
        sums[i] = sum / M_PI;
    }
    return sums;
}

} // namespace

/// Drawn by flux, all lights send the same; drawn in part by area, they still send what all texels send together.
TEST_F(Ism, LightsSendWhatTheMapsSend) {
    const glm::dvec3 bright(0.2126, 0.7152, 0.0722);
    for (const char* by_area : {"0", "0.5", "1"}) {
        make("ism", {{"vpls.vpls", "512"}, {"vpls.by_area", by_area}, {"splat.points", "16"}});
        ReflectiveShadowMaps maps(*run);
        double all = 0;
        for (int y = 0; y < maps.size.y; ++y)
            for (int x = 0; x < maps.size.x; ++x) {
                glm::dvec4 radiance = maps.radiance_at(0, x, y);
                if (!maps.holds(0, x, y) || radiance.a <= 1e-3) continue;
                // A texel's section across its own ray; the plane lies a metre away.
                double texel = 2 * std::tan(glm::radians(60.0)) / maps.size.x, z = maps.distance(0, x, y);
                glm::dvec2 on_plane = (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(maps.size)) * texel;
                double area = texel * texel * z * z / std::sqrt(1 + glm::dot(on_plane, on_plane));
                all += glm::dot(glm::dvec3(radiance), bright) / radiance.a * area;
            }
        double sent = 0, least = 1e30, most = 0;
        for (const Vpl& vpl : vpls()) {
            double one = glm::dot(glm::dvec3(vpl.intensity), bright);
            sent += one, least = std::min(least, one), most = std::max(most, one);
        }
        EXPECT_NEAR(sent / all, 1, by_area[0] == '0' && !by_area[1] ? 0.01 : 0.05) << by_area;
        if (std::string(by_area) == "0")
            EXPECT_LT(most, 1.01 * least);
        else
            EXPECT_GT(most, 1.5 * least) << by_area;
    }
}

/// The same texels become lights however bright the lamp is.
TEST_F(Ism, TheSameLightsAreDrawnOfAnyLamp) {
    const Sets sets{{"vpls.vpls", "512"}, {"splat.points", "16"}};
    make("ism_tuned", sets);
    const std::vector<Vpl> once = vpls();
    make("ism_tuned", sets, glm::vec3(0.37e-4f));
    const std::vector<Vpl> dim = vpls();
    int same = 0;
    for (size_t i = 0; i < once.size(); ++i)
        same += glm::length(once[i].position - dim[i].position) < 1e-4f ? 1 : 0;
    EXPECT_GE(same, int(once.size()) - 5);
}

/// Maps hold the distance to what rays meet first. As published a point's centre is as far as all of its splat.
TEST_F(Ism, MapsHoldWhatRaysMeet) {
    make("ism_tuned", {{"vpls.vpls", "16"}});
    Compared tuned = compare_with_rays();
    EXPECT_GT(tuned.texels, 8000);
    EXPECT_LT(tuned.wrong_share(), 0.03);
    EXPECT_EQ(tuned.holes, 0);
    RecordProperty("wrong", fmt::format("{} of {}", tuned.wrong, tuned.texels));
    make("ism", {{"vpls.vpls", "16"}});
    EXPECT_GT(compare_with_rays().wrong_share(), tuned.wrong_share());
}

/// Few points leave holes, which pull and push fill with about the right distance.
TEST_F(Ism, PullAndPushFillHoles) {
    make("ism_tuned", {{"splat.points", "1500"}, {"pull_push.levels", "0"}});
    Compared bare = compare_with_rays();
    make("ism_tuned", {{"splat.points", "1500"}});
    Compared filled = compare_with_rays();
    EXPECT_GT(bare.holes, bare.texels / 20);
    EXPECT_LT(filled.holes, bare.holes / 20);
    EXPECT_LT(filled.wrong - bare.wrong, bare.holes / 4) << "three of four holes get what rays meet";
}

/// Without maps the gather is a sum over all lights; with them no pixel gets more.
TEST_F(Ism, GathersTheSumOverItsLights) {
    make("ism", {{"gather.shadows", "false"}, {"gather.interleave", "1"}, {"gather.nearest", "0.05"}});
    const double diagonal = run->facts.bounds_over_animation.diagonal();
    std::vector<double> expected = sum_over_lights(*run, 0.05 * diagonal);
    std::vector<float> got = run->read("ism.irradiance");
    double mean = 0;
    int count = 0;
    for (size_t i = 0; i < expected.size(); ++i)
        if (expected[i] >= 0) mean += expected[i], ++count;
    ASSERT_GT(count, 100);
    mean /= count;
    for (size_t i = 0; i < expected.size(); ++i)
        if (expected[i] >= 0) {
            EXPECT_NEAR(got[4 * i + 1], expected[i], 1e-3 * expected[i] + 1e-3 * mean) << i;
        }
    run->set("gather.shadows", "true");
    run->frame();
    std::vector<float> shadowed = run->read("ism.irradiance");
    int less = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_LE(shadowed[4 * i + 1], got[4 * i + 1] * 1.0001f);
        less += shadowed[4 * i + 1] < 0.9f * got[4 * i + 1] ? 1 : 0;
    }
    EXPECT_GT(less, count / 20) << "the slab shades something";
}
