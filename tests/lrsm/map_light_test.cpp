// What reflective shadow maps tell of a point of a surface, against direct light and exact shadows; and maps of the
// environment, against the light that an open and a covered floor get from it.
#include "lrsm/crossings.h"
#include "lrsm/rsm_fixture.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr double k_pi = 3.14159265358979;

std::string literal(const std::vector<glm::dvec3>& values) {
    std::string text = fmt::format("vec3[{}](", values.size());
    for (size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}vec3({:.7f}, {:.7f}, {:.7f})", i ? ", " : "", values[i].x, values[i].y, values[i].z);
    return text + ")";
}

class MapLight : public SceneGraphTest {
  protected:
    /// What `call` tells of points met along directions.
    std::vector<glm::dvec3> told(const Scene& scene, const std::vector<Light>& lights, glm::vec3 environment,
                                 const std::string& call, const std::vector<glm::dvec3>& points,
                                 const std::vector<glm::dvec3>& directions) {
        shader("test/told.comp", fmt::format(R"(#include "surface/sky_bounce.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
const vec3 k_points[{0}] = {1}, k_directions[{0}] = {2};
void main() {{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= {0}) return;
    vec3 point = k_points[i], direction = k_directions[i];
    imageStore(test_result, ivec2(i, 0), vec4({3}, 1.0));
}}
)",
                                             points.size(), literal(points), literal(directions), call));
        std::string maps = lights.empty() ? R"({"id":"sky","type":"rsm","params":{"of":"environment","resolution":256},
            "bind":{"rsm.radiance":"sky.radiance","rsm.normal":"sky.normal","rsm.depth":"sky.depth","rsm.views":"sky.views",
                    "rsm.parallel":"sky.parallel"}})"
                                          : R"({"type":"rsm","params":{"resolution":256}})";
        std::string file = fmt::format(R"("resources":{{"test.result":{{"format":"rgba32f","size":[{},1]}}}},
            "passes":[{},{{"id":"told","type":"compute","shader":"test/told.comp"}}])",
                                       points.size(), maps);
        SceneRunner run(scene, lights, graph_file(file));
        run.set_environment(environment);
        run.frame();
        std::vector<float> got = run.read("test.result");
        std::vector<glm::dvec3> light;
        for (size_t i = 0; i < points.size(); ++i)
            light.emplace_back(got[4 * i], got[4 * i + 1], got[4 * i + 2]);
        if (!lights.empty()) return light;
        views = run.read_buffer<ShadowView>("sky.views");
        irradiance = run.read_buffer<glm::vec4>("sky.parallel");
        return light;
    }

    std::vector<ShadowView> views; // of the environment's maps
    std::vector<glm::vec4> irradiance;

    void compare(const Light& light) {
        Scene scene = blocks();
        std::vector<glm::dvec3> points, directions, expected;
        int lit = 0, behind = 0;
        for (int i = 0; points.size() < 64; ++i) {
            auto share = [&](int step, int prime) { return double(i * step % prime) / prime; };
            glm::dvec3 origin{-1.5 + 3.0 * share(37, 101), 0.05 + 1.2 * share(53, 97), -1.5 + 3.0 * share(29, 89)};
            double y = 1 - 2 * share(17, 79), around = 6.2831853 * share(41, 83), r = std::sqrt(1 - y * y);
            glm::dvec3 direction{r * std::cos(around), y, r * std::sin(around)};
            std::vector<Crossing> met = crossings(scene, origin, direction, 3);
            if (met.empty()) continue;
            glm::dvec3 p = origin + met[0].t * direction, to_light = -glm::dvec3(light.direction) * 100.0;
            if (light.type != LightType::directional) to_light = glm::dvec3(light.position) - p;
            double distance = glm::length(to_light);
            glm::dvec3 l = to_light / distance, n = met[0].normal;
            if (glm::dot(n, l) < 0) n = -n;
            // Neither at a shadow's edge nor at a rim, where texels hold another surface.
            int shadowed = 0;
            for (glm::dvec3 aside : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
                for (double step : {-0.04, 0.04}) {
                    glm::dvec3 q = p + step * (aside - n * glm::dot(n, aside));
                    bool on = !crossings(scene, q + 1e-3 * n, -n, 2e-3).empty();
                    shadowed += !on ? 100 : crossings(scene, q + 1e-6 * n, l, distance).empty() ? 0 : 1;
                }
            if (shadowed % 6 != 0 || shadowed > 6) continue;
            bool front = glm::dot(n, direction) < 0;
            glm::dvec3 sent(0);
            if (shadowed == 0 && front)
                sent = met[0].colour * glm::dvec3(light.intensity) * glm::dot(n, l) / k_pi /
                       (light.type == LightType::directional ? 1.0 : distance * distance);
            lit += shadowed == 0 && front, behind += shadowed == 0 && !front;
            points.push_back(p), directions.push_back(direction), expected.push_back(sent);
        }
        std::vector<glm::dvec3> got = told(scene, {light}, {}, "map_light(point, direction)", points, directions);
        int right = 0;
        for (size_t i = 0; i < got.size(); ++i)
            right += glm::length(got[i] - expected[i]) <= 0.03 * glm::length(expected[i]) + 1e-3;
        fmt::print("    {} of {} points: {} are lit where the ray comes from, {} behind\n", right, got.size(), lit,
                   behind);
        EXPECT_GE(right, 62);
        EXPECT_GT(lit, 12);
        EXPECT_GT(behind, 4);
    }
};

} // namespace

TEST_F(MapLight, IsWhatADirectionalLightMakesSurfacesSendBack) {
    compare(directional_light({-0.5f, -1, -0.3f}, {2, 2, 1}));
}
TEST_F(MapLight, IsWhatASpotMakesSurfacesSendBack) {
    // Of one intensity within the map.
    compare(spot_light({0.3f, 3, 0.2f}, {-0.1f, -1, 0.1f}, {9, 6, 3}, 60, 61));
}

/// ∫ L dω = 4πL, spread evenly; an open floor under L sends back ρL.
TEST_F(MapLight, OfTheEnvironmentIsWhatAnOpenFloorSendsBack) {
    glm::dvec3 down(0, -1, 0);
    Scene floor = MadeScene().quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, {0.8f, 0.4f, 0.2f}).scene;
    glm::dvec3 p(0.1, 0, 0.2);
    std::vector<glm::dvec3> got = told(floor, {}, {3, 2, 1}, "sky_bounce(point, direction, 0.0)",
                                       {p, p, p + glm::dvec3(0, 0.004, 0)}, {down, -down, down});
    ASSERT_EQ(irradiance.size(), 12u);
    glm::dvec4 sum(0);
    double lattice = 0; // irradiance of the floor by the views, over πL
    for (size_t i = 0; i < irradiance.size(); ++i) {
        sum += glm::dvec4(irradiance[i]);
        EXPECT_NEAR(irradiance[i].y, 4 * k_pi * 2 / 12, 0.15 * 4 * k_pi * 2 / 12) << i;
        lattice += double(irradiance[i].y) * std::max(-double(views[i].direction.y), 0.0) / (2 * k_pi);
    }
    EXPECT_NEAR(sum.x, 4 * k_pi * 3, 0.01);
    EXPECT_NEAR(lattice, 1, 0.03) << "twelve directions in place of all";
    glm::dvec3 expected = lattice * glm::dvec3(0.8 * 3, 0.4 * 2, 0.2);
    EXPECT_LT(glm::length(got[0] - expected), 0.01 * glm::length(expected));
    EXPECT_LT(glm::length(got[1] - expected), 0.01 * glm::length(expected)) << "from below as from above";
    EXPECT_LT(glm::length(got[2] - expected), 0.01 * glm::length(expected)) << "within half a texel of the plane";
}

TEST_F(MapLight, OfTheEnvironmentDoesNotReachIntoABox) {
    Scene box = MadeScene().box({-1, -1, -1}, {1, 1, 1}, {0.8f, 0.8f, 0.8f}).scene;
    std::vector<glm::dvec3> got = told(box, {}, {1, 1, 1}, "sky_bounce(point, direction, 0.0)",
                                       {{0.1, -1, 0.2}, {0.1, 1, 0.2}}, {{0, -1, 0}, {0, -1, 0}});
    EXPECT_EQ(got[0].x, 0) << "the floor from inside";
    EXPECT_GT(got[1].x, 0.7) << "the roof from outside";
}
