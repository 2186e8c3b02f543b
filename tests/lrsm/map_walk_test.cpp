// A ray's walk over a reflective shadow map against exact rays: where it first meets something lit, from which side,
// and the light that it sees there. What is in shadow does not count: no map shows it.
#include "lrsm/crossings.h"
#include "lrsm/rsm_fixture.h"

#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_rays = 800, k_resolution = 256;

struct Ray {
    glm::dvec3 origin, direction;
    /// As in GLSL below.
    explicit Ray(int i) {
        auto share = [&](int step, int prime) { return double(i * step % prime) / prime; };
        origin = {-1.5 + 3.0 * share(37, 101), 0.05 + 1.2 * share(53, 97), -1.5 + 3.0 * share(29, 89)};
        double y = 1 - 2 * share(17, 79), around = 6.2831853 * share(41, 83), r = std::sqrt(1 - y * y);
        direction = {r * std::cos(around), y, r * std::sin(around)};
    }
};
const char* const k_ray = R"(#define SHARE(step, prime) (float(i * step % prime) / float(prime))
    vec3 origin = vec3(-1.5 + 3.0 * SHARE(37, 101), 0.05 + 1.2 * SHARE(53, 97), -1.5 + 3.0 * SHARE(29, 89));
    float y = 1.0 - 2.0 * SHARE(17, 79), around = 6.2831853 * SHARE(41, 83), r = sqrt(1.0 - y * y);
    vec3 direction = vec3(r * cos(around), y, r * sin(around));)";

class MapWalk : public SceneGraphTest {
  protected:
    void compare(const Light& light, double least_share) {
        shader("test/walk.comp", fmt::format(R"(#include "surface/map_walk.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
void main() {{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(test_result).x) return;
    {}
    float met;
    vec3 light;
    bool in_light;
    bool any_met = walk_map(0, origin, direction, direction, 0.0, 2.0, met, light, in_light);
    imageStore(test_result, ivec2(i, 0), vec4(any_met ? met : -1.0, in_light ? 1.0 : 0.0, light.rg));
}}
)",
                                             k_ray));
        std::string file = fmt::format(
            R"("resources":{{"test.result":{{"format":"rgba32f","size":[{},1]}}}},
               "passes":[{{"type":"rsm","params":{{"resolution":{}}}}},
                         {{"id":"walk","type":"compute","shader":"test/walk.comp","params":{{"map_steps":512}}}}])",
            k_rays, k_resolution);
        SceneRunner run(blocks(), {light}, graph_file(file));
        run.frame();
        std::vector<float> got = run.read("test.result");
        // Off the plane that is met: 5 m are 256 texels, and half a texel is the walk's own tolerance.
        const double slack = 0.03;
        int agree = 0, fronts = 0, backs = 0, lit_all = 0, wrongly_lit = 0, dim = 0;
        for (int i = 0; i < k_rays; ++i) {
            Ray ray(i);
            double expected = -1, across = 1;
            bool front = false;
            glm::dvec3 sent(0);
            std::vector<Crossing> on_the_way = crossings(run.scene, ray.origin, ray.direction, 2);
            for (const Crossing& c : on_the_way) {
                glm::dvec3 p = ray.origin + c.t * ray.direction;
                glm::dvec3 to_light = light.type == LightType::directional ? -glm::dvec3(light.direction) * 100.0
                                                                           : glm::dvec3(light.position) - p;
                double distance = glm::length(to_light);
                glm::dvec3 l = to_light / distance;
                glm::dvec3 n = glm::dot(c.normal, l) < 0 ? -c.normal : c.normal;
                if (!crossings(run.scene, p + 1e-6 * n, l, distance).empty()) continue;
                expected = c.t;
                across = std::abs(glm::dot(n, ray.direction));
                front = glm::dot(n, ray.direction) < 0;
                if (light.type == LightType::directional)
                    sent = c.colour * glm::dvec3(light.intensity) * glm::dot(n, l) / 3.14159265358979;
                break;
            }
            double met = got[size_t(4 * i)];
            glm::dvec2 light_seen(got[size_t(4 * i) + 2], got[size_t(4 * i) + 3]);
            bool same = (expected < 0) == (met < 0) && (expected < 0 || std::abs(met - expected) * across < slack) &&
                        (expected < 0 || front == (light_seen.x > 0));
            agree += same;
            fronts += same && front;
            backs += same && expected >= 0 && !front;
            if (same && front && light.type == LightType::directional &&
                std::abs(light_seen.x - sent.x) > 0.01 * sent.x + 1e-3)
                ++dim;
            // The certainty that a walk gives: what is lit from end to end meets nothing at all.
            bool said_lit = got[size_t(4 * i) + 1] > 0 && met < 0;
            lit_all += said_lit;
            wrongly_lit += said_lit && !on_the_way.empty();
        }
        fmt::print("    {} of {} rays agree: {} meet a lit side, {} a back; {} stay in light, {} of them wrongly\n",
                   agree, k_rays, fronts, backs, lit_all, wrongly_lit);
        EXPECT_GT(agree, least_share * k_rays);
        EXPECT_GT(fronts, k_rays / 20);
        EXPECT_GT(backs, k_rays / 40) << "rays from below the floor's level and through the slab";
        EXPECT_GT(lit_all, k_rays / 20);
        EXPECT_LE(wrongly_lit, lit_all / 20);
        EXPECT_LE(dim, fronts / 20) << "another surface's light";
    }
};

} // namespace

// The rest lies within texels of rims and shadows' edges.
TEST_F(MapWalk, MeetsWhatADirectionalLightReaches) {
    compare(directional_light({-0.5f, -1, -0.3f}, {2, 2, 1}), 0.95);
}
TEST_F(MapWalk, MeetsWhatASpotReaches) {
    compare(spot_light({0.3f, 3, 0.2f}, {-0.1f, -1, 0.1f}, {9, 6, 3}, 20, 42), 0.95);
}
