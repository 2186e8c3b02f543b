// Rays that are pinned are those that the debug views record: read from the GPU by structures of C++ that mirror
// GLSL's.
#include "app/session.h"
#include "app/ui/pinned_rays.h"
#include "app/ui/texel.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "tiny_session.h"

#include <gtest/gtest.h>

using namespace bounce;

namespace {

class PinnedRaysTest : public GpuTest {
  protected:
    /// Renders with the view on, at the middle of the picture.
    std::optional<PinnedRays> pinned(const std::string& graph, const std::string& inspect, const std::string& view) {
        SessionOptions options = tiny_session(root.path());
        options.graph = graph;
        options.resource = view;
        if (inspect != "tonemap") options.sets.emplace_back(inspect + ".pixel", "0.5,0.7");
        for (const auto& [name, value] : settings)
            options.sets.emplace_back(name, value);
        session = std::make_unique<Session>(options);
        session->render(true);
        return recorded_rays(session->graph(), view, session->constants().scene_diagonal);
    }
    /// The surface that the picture shows there.
    glm::vec3 surface() const {
        const glm::ivec2 size = session->size(), pixel(int(0.5f * float(size.x)), int(0.7f * float(size.y)));
        const std::vector<float> depth = session->graph().texture("gbuffer.depth")->read();
        return *world_position(session->constants(), pixel, depth[size_t(pixel.y * size.x + pixel.x)]);
    }

    TempRoot root;
    std::vector<std::pair<std::string, std::string>> settings;
    std::unique_ptr<Session> session;
};

} // namespace

TEST_F(PinnedRaysTest, RaysOfMapsStartAtTheSurfaceAndEndOnTheScene) {
    settings = {{"ldm.maps", "32"}, {"ldm.resolution", "32"}};
    const auto rays = pinned("ldm_ao", "inspect", "debug.rays_view");
    ASSERT_TRUE(rays);
    EXPECT_LT(glm::distance(rays->origin, surface()), 1e-3f);
    EXPECT_GT(rays->rays.size(), 8u); // those above the surface
    EXPECT_LE(rays->rays.size(), 32u);
    size_t hits = 0;
    for (const PinnedRay& ray : rays->rays) {
        EXPECT_GT(ray.strength, 0);
        EXPECT_LE(ray.strength, 1);
        EXPECT_GT(ray.end.y, rays->origin.y - 0.05f) << "below the floor";
        if (!ray.hits) continue;
        ++hits;
        EXPECT_LT(ray.end.y, 0.66f) << "above the box, which is the highest there is";
    }
    EXPECT_GT(hits, 0u);
    EXPECT_LT(hits, rays->rays.size());
}

TEST_F(PinnedRaysTest, AFanOfVisibilityFiltering) {
    settings = {{"vf_proxies.proxies", "2000"}};
    const auto rays = pinned("vf", "inspect_fan", "debug.vf_fan");
    ASSERT_TRUE(rays);
    EXPECT_LT(glm::distance(rays->origin, surface()), 0.2f); // of a texel of the low resolution
    const int wanted = std::get<int>(session->graph().model().parameter("visibility.rays").value);
    EXPECT_EQ(int(rays->rays.size()), wanted);
    for (const PinnedRay& ray : rays->rays)
        EXPECT_NEAR(ray.hits ? 1.0f : glm::distance(ray.end, rays->origin) / session->constants().scene_diagonal, 1.0f,
                    1e-3f);
}

TEST_F(PinnedRaysTest, ConesWithTheirWidth) {
    settings = {{"occlusion_voxels.resolution", "32"}, {"rsm.resolution", "32"}};
    const auto cones = pinned("lrsm", "inspect", "debug.cones_view");
    ASSERT_TRUE(cones);
    EXPECT_LT(glm::distance(cones->origin, surface()), 0.1f); // it starts a little above the surface
    EXPECT_EQ(cones->rays.size(), 6u);
    for (const PinnedRay& cone : cones->rays) {
        const float length = glm::distance(cone.end, cones->origin);
        ASSERT_GT(length, 0);
        EXPECT_NEAR(cone.radius / length, cones->rays[0].radius / glm::distance(cones->rays[0].end, cones->origin),
                    1e-4f);
        EXPECT_GT(cone.radius, 0);
    }
}

TEST_F(PinnedRaysTest, NothingWhereNothingIsRecorded) {
    EXPECT_FALSE(pinned("direct", "tonemap", "out.display").has_value());
}
