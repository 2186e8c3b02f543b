// The gather over voxels whose rays walk over the reflective shadow maps, in a closed room: what the maps say is what a
// ray sees of the lights, and what voxels know beside that (bounces before, emission) is added.
#include "support/scene_runner.h"

#include <algorithm>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_pixels = 24;

class WalkedGather : public SceneGraphTest {
  protected:
    /// Mean of red over the picture of what is gathered in a room of 2 m; the maps show `in_maps` everywhere, the
    /// voxels `direct` of the lights and `base` in all.
    double gathered(double in_maps, double direct, double base, const char* hit_lookup, double* darkest = nullptr,
                    const char* hit = "plane") {
        shader("test/uniform_radiance.comp", fmt::format(R"(layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_rsm_radiance) uniform image2DArray rsm_radiance;
void main() {{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(rsm_radiance)))) return;
    imageStore(rsm_radiance, at, vec4(vec3({}), imageLoad(rsm_radiance, at).a));
}}
)",
                                                         in_maps));
        shader("test/fill.comp", fmt::format(R"(layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(FORMAT_dvs_radiance) writeonly uniform image3D dvs_radiance;
layout(FORMAT_dvs_base) writeonly uniform image3D dvs_base;
layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional; // exact hits do not read it
void main() {{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(dvs_base)))) return;
    imageStore(dvs_radiance, at, vec4(vec3({}), 1.0));
    imageStore(dvs_base, at, vec4(vec3({}), 1.0));
    imageStore(dvs_directional, at, vec4(0.0));
}}
)",
                                             direct, base));
        std::string file = fmt::format(
            R"("resources":{{"dvs.irradiance":{{}},"dvs.radiance":{{"kind":"texture_3d","format":"rgba16f","size":[32,32,64]}},
                 "dvs.base":{{"kind":"texture_3d","format":"rgba16f","size":[32,32,64]}},
                 "dvs.directional":{{"kind":"texture_3d","format":"rgba16f","size":[64,96,32]}}}},
               "passes":[{{"type":"gbuffer"}},
                 {{"type":"voxelization","params":{{"resolution":32,"route":"compute","averaging":"sum","planes":true}}}},
                 {{"id":"fill","type":"compute","shader":"test/fill.comp","dispatch":"dvs.base"}},
                 {{"type":"rsm","params":{{"resolution":128}}}},
                 {{"id":"uniform","type":"compute","shader":"test/uniform_radiance.comp","dispatch":"rsm.radiance"}},
                 {{"type":"bvh"}},
                 {{"id":"gather","type":"compute","shader":"dvs/gather.comp","params":{{"cone_set":"spiral","spiral_cones":16,
                   "start_offset":0,"normal_offset":0.5,"hit_then_sample":true,"exact_hits":true,"hit_lookup":"{}","hit":"{}"}}}}])",
            hit_lookup, hit);
        // Lit from its middle, so that the six maps see every wall.
        SceneRunner run(MadeScene().box({-1, -1, -1}, {1, 1, 1}, glm::vec3(0.5f), true).scene,
                        {point_light({0, 0, 0}, {1, 1, 1})}, graph_file(file), {}, {k_pixels, k_pixels});
        run.camera.position = {0.3f, 0.1f, 0.9f};
        run.camera.target = {0.1f, -0.2f, 0};
        run.camera.vfov = 1.6f;
        run.frame();
        std::vector<float> got = run.read("dvs.irradiance");
        double sum = 0;
        if (darkest) *darkest = 1e9;
        for (size_t i = 0; i < got.size(); i += 4) {
            sum += double(got[i]) / double(got.size() / 4);
            if (darkest) *darkest = std::min(*darkest, double(got[i]));
        }
        return sum;
    }
};

} // namespace

TEST_F(WalkedGather, SeesOfTheLightsWhatTheMapsShow) {
    double darkest = 0, walked = gathered(0.75, 0.25, 0.25, "map", &darkest);
    double voxels = gathered(0.75, 0.25, 0.25, "voxels");
    fmt::print("    {:.4f} by walks (darkest pixel {:.3f}), {:.4f} by voxels\n", walked, darkest, voxels);
    // Where the edges of two maps meet a texel may be missed: then the voxel says that no light reaches it.
    EXPECT_NEAR(walked, 0.75, 0.015);
    EXPECT_GT(darkest, 0.6);
    EXPECT_NEAR(voxels, 0.25, 0.0025);
}

TEST_F(WalkedGather, AddsWhatVoxelsKnowBesideTheLights) {
    double bounced = gathered(0, 0.25, 0.75, "map"), both = gathered(0.25, 0.25, 0.75, "map");
    fmt::print("    {:.4f} in the dark, {:.4f} with light\n", bounced, both);
    EXPECT_NEAR(bounced, 0.5, 0.01);
    EXPECT_NEAR(both, 0.75, 0.015);
}

/// Triangles end rays exactly, near by or everywhere.
TEST_F(WalkedGather, WithTrianglesItIsTheSame) {
    for (const char* hit : {"near_triangle", "triangle"}) {
        double light = gathered(0.75, 0.25, 0.25, "map", nullptr, hit),
               both = gathered(0.25, 0.25, 0.75, "map", nullptr, hit);
        fmt::print("    {}: {:.4f} in light, {:.4f} with what voxels know\n", hit, light, both);
        EXPECT_NEAR(light, 0.75, 0.01) << hit;
        EXPECT_NEAR(both, 0.75, 0.015) << hit;
    }
}
