// The shaders' traced rays against Embree's, on whole scenes: alpha, copies, things that move.
// BOUNCE_TRACED_RAYS=1000000 asks for more rays than the ordinary run.
#include "reference/geometry.h"
#include "support/ray_probe.h"
#include "support/shared_scene.h"

#include <cstdlib>
#include <fmt/format.h>

using namespace bounce;

namespace {

struct SceneCase {
    const char* shot;
    const char* needs; ///< a scene beside the tree, or empty
    int frame;
    /// Share of the rays that may differ: those that meet a texture's alpha within a rounding step of its cutoff.
    double may_differ;
};

void PrintTo(const SceneCase& scene_case, std::ostream* out) {
    *out << scene_case.shot << " " << scene_case.needs;
}

class TracedScenes : public SceneGraphTest, public testing::WithParamInterface<SceneCase> {
  protected:
    void SetUp() override {
        SceneGraphTest::SetUp();
        // The fixture's root is far from the scenes beside the source tree.
        if (!shared_scene("").empty() && !std::getenv("BOUNCE_SCENES"))
            setenv("BOUNCE_SCENES", shared_scene("").c_str(), 1);
    }
};

int ray_count() {
    const char* asked = std::getenv("BOUNCE_TRACED_RAYS");
    return asked ? std::atoi(asked) : 20000;
}

} // namespace

TEST_P(TracedScenes, AgreeWithEmbree) {
    const SceneCase& scene_case = GetParam();
    if (*scene_case.needs && shared_scene(scene_case.needs).empty())
        GTEST_SKIP() << "the scene " << scene_case.needs << " is not beside the source tree";
    const Shot shot =
        load_shot(*scene_case.needs && std::string(scene_case.shot).empty() ? shared_scene(scene_case.needs).string()
                                                                            : std::string(scene_case.shot));
    const ShotState state = evaluate_shot(shot, scene_case.frame);
    const TraceGeometry embree(shot, state.scene, false);
    const int count = ray_count();
    shader("user/probe.comp", probe_shader(k_rays_through_bounds));
    for (const auto& [wide, shared] : {std::pair("false", "false"), {"true", "false"}, {"false", "true"}}) {
        SceneRunner run(shot.scene, {}, graph_file(probe_graph(count)),
                        {{"bvh.wide_nodes", wide}, {"bvh.share_all", shared}});
        run.state = state.scene;
        run.frame();
        const auto diagonal = run.facts.bounds_over_animation.diagonal();
        int differ = 0, rims = 0, hits = 0;
        for (const ProbedRay& ray : run.read_buffer<ProbedRay>("probe.rays")) {
            const Hit hit = embree.intersect(ray.origin, ray.direction, std::numeric_limits<float>::infinity());
            EXPECT_EQ(ray.any != 0, ray.hit());
            hits += hit.valid();
            if (!hit.valid() && !ray.hit()) continue;
            if (hit.valid() && ray.hit()) {
                const Primitive& primitive = state.scene.instances[ray.draw].primitive;
                if (hit.geometry == ray.draw && hit.triangle == (ray.corner - primitive.first_index) / 3) continue;
                if (std::abs(hit.distance - ray.t) <= 1e-5f * std::max(hit.distance, 0.1f * diagonal)) continue;
            }
            // A ray through the rim of what it meets first may fall on either side of it.
            const bool ours = ray.hit() && (!hit.valid() || ray.t < hit.distance);
            const glm::vec2 uv = ours ? ray.uv : glm::vec2(hit.u, hit.v);
            ++(std::min({uv.x, uv.y, 1 - uv.x - uv.y}) < 1e-4f ? rims : differ);
        }
        fmt::print("    {:<24} {:<6} {:<6} {} rays, {} hits, {} differ from Embree's, {} at rims\n",
                   scene_case.shot[0] ? scene_case.shot : scene_case.needs,
                   wide == std::string("true") ? "wide" : "listed", shared == std::string("true") ? "shared" : "",
                   count, hits, differ, rims);
        EXPECT_GT(hits, count / 20);
        EXPECT_LE(differ, scene_case.may_differ * count);
        EXPECT_LE(rims, 1e-5 * count);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, TracedScenes,
    testing::Values(SceneCase{"cornell", "", 0, 0}, SceneCase{"cornell_moving_object", "bunny/bunny.gltf", 7, 0},
                    SceneCase{"animated", "", 20, 0}, SceneCase{"gallery", "", 0, 0}, SceneCase{"atrium", "", 0, 1e-4},
                    SceneCase{"hairball", "", 0, 0}, SceneCase{"sponza", "sponza/Sponza.gltf", 0, 1e-4},
                    SceneCase{"sponza_dragons", "dragon/dragon.gltf", 30, 1e-4},
                    SceneCase{"sibenik", "sibenik/Sibenik.gltf", 0, 1e-4},
                    SceneCase{"", "conference/Conference.gltf", 0, 0}),
    [](const auto& named) { return named.param.shot[0] ? std::string(named.param.shot) : "conference"; });
