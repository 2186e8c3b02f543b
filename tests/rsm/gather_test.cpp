// The gather from reflective shadow maps against a direct sum over all texels of the maps as the graph left them, and
// against an integral over the lit surface itself.
#include "lrsm/rsm_fixture.h"

#include <algorithm>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_pixels = 12;

struct Receiver {
    glm::dvec3 position, normal;
    bool surface = false;
};

class RsmGather : public SceneGraphTest {
  protected:
    SceneRunner& make(Scene scene, std::vector<Light> lights, int resolution,
                      const std::vector<std::pair<std::string, std::string>>& sets, int width = k_pixels) {
        std::string file = fmt::format(
            R"("resources":{{"rsm.irradiance":{{"format":"rgba32f","size":[{0},{0}]}},
                             "rsm.refined":{{"format":"rgba32f"}},"test.position":{{"format":"rgba32f"}},
                             "gbuffer.normal":{{"format":"rgba32f"}},"rsm.normal":{{"format":"rgba32f"}},
                             "rsm.radiance":{{"format":"rgba32f"}}}},
               "passes":[{{"type":"gbuffer"}},{{"type":"rsm","params":{{"resolution":{1}}}}},
                 {{"id":"gather","type":"compute","shader":"rsm/gather.comp"}},
                 {{"id":"refine","type":"compute","shader":"rsm/refine.comp","params_of":"gather"}},
                 {{"id":"where","type":"compute","shader":"test/where.comp"}}])",
            width, resolution);
        shader("test/where.comp", R"(#include "lib/frame.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D gbuffer_depth;
layout(FORMAT_test_position) writeonly uniform image2D test_position;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    imageStore(test_position, pixel, depth > 0.0 ? vec4(world_position(pixel, depth), 1.0) : vec4(0.0));
}
)");
        run_ = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(file), sets,
                                             glm::ivec2(k_pixels));
        run_->camera.position = {0.9f, 1.1f, 2.4f};
        run_->camera.target = {0, 0.4f, 0};
        run_->camera.vfov = 1.0f;
        run_->frame();
        return *run_;
    }
    std::vector<Receiver> receivers() const {
        std::vector<float> position = run_->read("test.position"), normal = run_->read("gbuffer.normal");
        std::vector<Receiver> all(k_pixels * k_pixels);
        for (size_t i = 0; i < all.size(); ++i)
            all[i] = {glm::dvec3(ReflectiveShadowMaps::four(position, i)),
                      glm::dvec3(ReflectiveShadowMaps::four(normal, i)), position[4 * i + 3] > 0};
        return all;
    }
    /// E/π by all texels of all maps: each a patch across its own ray.
    static glm::dvec3 direct_sum(const ReflectiveShadowMaps& maps, const Receiver& at) {
        glm::dvec3 sum(0);
        for (int view = 0; view < maps.size.z; ++view) {
            const ShadowView& v = maps.views[size_t(view)];
            glm::dmat4 inverse = glm::inverse(glm::dmat4(v.view_projection));
            auto on_plane = [&](double x, double y) {
                glm::dvec4 p = inverse * glm::dvec4(2 * x / maps.size.x - 1, 2 * y / maps.size.y - 1,
                                                    v.range > 0 ? 1.0 : double(v.near_plane), 1);
                return glm::dvec3(p) / p.w;
            };
            for (int y = 0; y < maps.size.y; ++y) {
                for (int x = 0; x < maps.size.x; ++x) {
                    glm::dvec4 radiance = maps.radiance_at(view, x, y);
                    glm::dvec2 ndc = (glm::dvec2(x, y) + 0.5) / glm::dvec2(maps.size) * 2.0 - 1.0;
                    if (!maps.holds(view, x, y) || radiance.a <= 1e-3) continue;
                    if (std::max(std::abs(ndc.x), std::abs(ndc.y)) > double(v.window)) continue;
                    glm::dvec3 middle = on_plane(x + 0.5, y + 0.5), origin(v.origin), direction(v.direction);
                    glm::dvec3 patch = glm::cross(on_plane(x + 1, y + 0.5) - on_plane(x, y + 0.5),
                                                  on_plane(x + 0.5, y + 1) - on_plane(x + 0.5, y));
                    glm::dvec3 place = middle + maps.distance(view, x, y) * direction;
                    double area = glm::length(patch);
                    if (v.range == 0) { // the plane lies a metre away
                        double z = maps.distance(view, x, y);
                        glm::dvec3 ray = middle - origin;
                        place = origin + z * ray;
                        area = std::abs(glm::dot(patch, glm::normalize(ray))) * z * z;
                    }
                    glm::dvec3 to = at.position - place;
                    double squared = glm::dot(to, to);
                    double cosines = std::max(glm::dot(glm::dvec3(maps.normal_at(view, x, y)), to), 0.0) *
                                     std::max(-glm::dot(at.normal, to), 0.0) / squared;
                    if (squared > 0) sum += glm::dvec3(radiance) / radiance.a * area * cosines / squared / M_PI;
                }
            }
        }
        return sum;
    }
    /// The largest difference, as a share of the mean over all receivers.
    double worst_difference(const std::string& resource, const std::vector<glm::dvec3>& expected) const {
        std::vector<float> got = run_->read(resource);
        std::vector<Receiver> all = receivers();
        double mean = 0, worst = 0;
        int count = 0;
        for (size_t i = 0; i < all.size(); ++i)
            if (all[i].surface) mean += expected[i].g, ++count;
        EXPECT_GT(count, k_pixels * k_pixels / 2);
        EXPECT_GT(mean, 0);
        mean /= count;
        for (size_t i = 0; i < all.size(); ++i)
            if (all[i].surface) worst = std::max(worst, std::abs(got[4 * i + 1] - expected[i].g) / mean);
        return worst;
    }
    std::vector<glm::dvec3> expected_sums() const {
        ReflectiveShadowMaps maps(*run_);
        std::vector<glm::dvec3> expected;
        for (const Receiver& at : receivers())
            expected.push_back(direct_sum(maps, at));
        return expected;
    }
    std::unique_ptr<SceneRunner> run_;
};

/// Lights high above, so that no texel lies close to a receiver and each counts for little.
std::vector<Light> high_lights(int which) {
    return {std::vector<Light>{spot_light({0.4f, 2.5f, 0.3f}, {-0.1f, -1, -0.1f}, {9, 6, 3}, 25, 45),
                               point_light({0.6f, 2.2f, 0.5f}, {3, 4, 5}),
                               directional_light({-0.4f, -1, -0.3f}, {2, 2, 1})}[size_t(which)]};
}
const std::vector<std::pair<std::string, std::string>> k_every{{"gather.pattern", "every_texel"}};

} // namespace

TEST_F(RsmGather, OfEveryTexelIsTheSumOverAllTexels) {
    for (int which : {0, 1, 2}) {
        make(blocks(), high_lights(which), 32, k_every);
        EXPECT_LT(worst_difference("rsm.irradiance", expected_sums()), 0.01) << "light " << which;
    }
}

/// Several lights are several sums.
TEST_F(RsmGather, OfSeveralLightsIsTheSumOfTheirs) {
    make(blocks(), {high_lights(0)[0], high_lights(2)[0]}, 32, k_every);
    EXPECT_LT(worst_difference("rsm.irradiance", expected_sums()), 0.01);
}

/// A pattern as wide as the map has the same mean when it is weighted by ξ. As published, by ξ², it has not.
TEST_F(RsmGather, OfAWideDiscIsUnbiasedOnlyWithTheLinearWeight) {
    std::vector<std::pair<std::string, std::string>> disc{{"gather.samples", "4096"},
                                                          {"gather.radius", "1.5"},
                                                          {"gather.keep_inside", "true"},
                                                          {"gather.weight", "linear"}};
    // Of the means over all receivers, to that of every texel.
    auto ratio = [&] {
        std::vector<glm::dvec3> expected = expected_sums();
        std::vector<float> got = run_->read("rsm.irradiance");
        double is = 0, shall_be = 0;
        for (size_t i = 0; i < expected.size(); ++i)
            is += got[4 * i + 1], shall_be += expected[i].g;
        return is / shall_be;
    };
    make(blocks(), high_lights(0), 64, {{"gather.pattern", "whole_map"}, {"gather.samples", "4096"}});
    EXPECT_NEAR(ratio(), 1, 0.03);
    make(blocks(), high_lights(0), 64, disc);
    double linear = ratio();
    EXPECT_NEAR(linear, 1, 0.03);
    disc[3].second = "squared";
    make(blocks(), high_lights(0), 64, disc);
    EXPECT_LT(ratio(), 0.8 * linear) << "ξ² takes weight from what lies near, and gives it to what lies beside the map";
}

/// A floor lit from straight above sends light to a wall that stands edge-on to the light: an integral over the floor.
TEST_F(RsmGather, OfAFloorIsTheIntegralOverIt) {
    const glm::dvec3 colour(0.8f, 0.4f, 0.2f);
    Scene scene = MadeScene()
                      .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, glm::vec3(colour))
                      .quad({-1, 0.2f, -1}, {1, 0.2f, -1}, {1, 1.2f, -1}, {-1, 1.2f, -1})
                      .scene;
    make(scene, {directional_light({0, -1, 0}, {3, 3, 3})}, 128,
         {{"gather.pattern", "whole_map"}, {"gather.samples", "4096"}});
    std::vector<float> got = run_->read("rsm.irradiance");
    std::vector<Receiver> all = receivers();
    int compared = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        if (!all[i].surface || all[i].normal.z < 0.9) continue;
        double sum = 0;
        constexpr int k_steps = 200;
        for (int k = 0; k < k_steps * k_steps; ++k) {
            glm::dvec3 p((k % k_steps + 0.5) * 2 / k_steps - 1, 0, (k / k_steps + 0.5) * 2 / k_steps - 1);
            glm::dvec3 to = all[i].position - p;
            sum += std::max(to.y, 0.0) * std::max(-glm::dot(all[i].normal, to), 0.0) / std::pow(glm::dot(to, to), 2);
        }
        double expected = colour.g * 3 / M_PI * sum * (2.0 / k_steps) * (2.0 / k_steps) / M_PI;
        EXPECT_NEAR(got[4 * i + 1] / expected, 1, 0.04) << i;
        ++compared;
    }
    EXPECT_GT(compared, 15);
}

/// Pixels whose neighbours do not agree gather by themselves: what the gather finds at the picture's own size.
TEST_F(RsmGather, RefinesWhereFewerThanThreeTexelsAgree) {
    make(blocks(), high_lights(0), 32, {}, k_pixels);
    std::vector<float> whole = run_->read("rsm.irradiance"), same = run_->read("rsm.refined");
    for (size_t i = 0; i < whole.size(); i += 4)
        EXPECT_NEAR(same[i], whole[i], 1e-6 + 1e-4 * whole[i]) << "at its own size nothing is interpolated";
    make(blocks(), high_lights(0), 32, {}, k_pixels / 4);
    std::vector<float> refined = run_->read("rsm.refined");
    std::vector<Receiver> all = receivers();
    int own = 0, between = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        if (!all[i].surface) continue;
        bool gathered = refined[4 * i + 3] > 0;
        (gathered ? own : between) += 1;
        if (gathered) {
            EXPECT_NEAR(refined[4 * i], whole[4 * i], 1e-6 + 1e-4 * whole[4 * i]) << i;
        }
    }
    EXPECT_GT(own, 5);
    EXPECT_GT(between, 5);
}
