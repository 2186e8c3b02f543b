// The final gather in a closed room whose walls all send on the same radiance L: every cone ends on a wall, so each
// pixel must gather L. Cones through voxels filled by hand: nothing in an empty grid, everything in front of thick
// walls.
#include "lrsm/rsm_fixture.h"

#include <algorithm>
#include <fmt/format.h>

using namespace bounce;

namespace {

const glm::dvec3 k_radiance(0.75, 0.5, 0.25);
constexpr int k_pixels = 24;

using Sets = std::vector<std::pair<std::string, std::string>>;

/// Departures from the paper, as lrsm_tuned has them.
const Sets k_tuned{
    {"gather.cone_set", "spiral"},         {"gather.spiral_cones", "16"},       {"gather.aperture", "4"},
    {"gather.hit_then_sample", "true"},    {"gather.max_steps", "300"},         {"gather.estimator", "lit_fraction"},
    {"gather.normalised_normals", "true"}, {"gather.layers_by_sphere", "true"}, {"gather.depth_window", "2"}};

struct Gathered {
    glm::dvec3 mean{0};
    double open = 0, brightest = 0, darkest = 1e9; ///< mean openness; of red, as a share of L
    double most_open = 0, least_open = 1;
};

class Gather : public SceneGraphTest {
  protected:
    /// `fill`: the voxels as an expression of `v`; "" for those of the room.
    Gathered gather(const std::string& fill, bool leaves, Sets sets) {
        shader("test/uniform_radiance.comp", R"(layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_rsm_radiance) uniform image2DArray rsm_radiance;
void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(rsm_radiance)))) return;
    imageStore(rsm_radiance, at, vec4(0.75, 0.5, 0.25, imageLoad(rsm_radiance, at).a));
}
)");
        shader("test/fill.comp", R"(layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(FORMAT_voxels_occlusion) writeonly uniform image3D voxels_occlusion;
void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(voxels_occlusion), v = ivec3(at.xy, at.z % size.x);
    if (all(lessThan(at, size))) imageStore(voxels_occlusion, at, vec4()" +
                                     (fill.empty() ? "0.0" : fill) +
                                     R"());
}
)");
        std::string voxels =
            R"({"type":"occlusion_voxels","params":{"resolution":32,"route":"compute","directional_leaves":)" +
            std::string(leaves ? "true}}" : "false}}");
        if (!fill.empty()) voxels = R"({"id":"fill","type":"compute","shader":"test/fill.comp"})";
        std::string file = fmt::format(
            R"("resources":{{{}"lrsm.irradiance":{{}},"lrsm.normal_table":{{"format":"r32f","size":[256,1]}}}},
               "passes":[{{"type":"gbuffer"}},{},
                 {{"id":"voxel_mips","type":"compute","shader":"voxel/occlusion_mips.comp","params":{{"mip_rule":"along_leaf"}},
                   "bind":{{"voxels.finer":{{"resource":"voxels.occlusion","mip":"iteration - 1"}},
                            "voxels.coarser":{{"resource":"voxels.occlusion","mip":"iteration"}}}},
                   "repeat":{{"over":"mips","of":"voxels.occlusion","from":1}}}},
                 {{"type":"rsm","params":{{"resolution":128}}}},
                 {{"id":"uniform","type":"compute","shader":"test/uniform_radiance.comp","dispatch":"rsm.radiance"}},
                 {{"type":"lrsm_layers"}},{},
                 {{"id":"normal_table","type":"compute","shader":"lrsm/normal_table.comp"}},
                 {{"id":"gather","type":"compute","shader":"lrsm/gather.comp"}}])",
            fill.empty()
                ? ""
                : fmt::format(R"("voxels.occlusion":{{"kind":"texture_3d","format":"r8","size":[32,32,{}],"mips":6}},)",
                              leaves ? 192 : 32),
            voxels, k_mips_pass);
        // A room of 2 m, lit from its middle so that the six maps see every wall.
        SceneRunner run(MadeScene().box({-1, -1, -1}, {1, 1, 1}, glm::vec3(0.5f), true).scene,
                        {point_light({0, 0, 0}, {1, 1, 1})}, graph_file(file), sets, {k_pixels, k_pixels});
        run.camera.position = {0.3f, 0.1f, 0.9f};
        run.camera.target = {0.1f, -0.2f, 0};
        run.camera.vfov = 1.6f;
        run.frame();
        std::vector<float> got = run.read("lrsm.irradiance"), depth = run.read("gbuffer.depth");
        Gathered result;
        for (size_t i = 0; i < depth.size(); ++i) {
            EXPECT_GT(depth[i], 0) << "the room is not closed";
            glm::dvec3 light(got[4 * i], got[4 * i + 1], got[4 * i + 2]);
            double open = got[4 * i + 3], share = light.r / k_radiance.r;
            result.mean += light / double(depth.size());
            result.open += open / double(depth.size());
            result.brightest = std::max(result.brightest, share), result.darkest = std::min(result.darkest, share);
            result.most_open = std::max(result.most_open, open), result.least_open = std::min(result.least_open, open);
        }
        return result;
    }
    void note(const std::string& what, const Gathered& g) {
        fmt::print("    {:<24} gathers {:.3f} of L, {:.3f} to {:.3f}; open {:.4f}\n", what, g.mean.r / k_radiance.r,
                   g.darkest, g.brightest, g.open);
    }
};

} // namespace

TEST_F(Gather, InAnEmptyGridIsOpenAndDark) {
    for (const char* set : {"six", "six_tilted", "spiral"}) {
        for (bool leaves : {false, true}) {
            Gathered g = gather("0.0", leaves, {{"gather.cone_set", set}});
            EXPECT_NEAR(g.least_open, 1, 1e-3) << set;
            EXPECT_EQ(g.brightest, 0) << set;
        }
    }
}

/// Walls as thick as the widest sphere leave nothing open, whatever the set: but for cones next to a corner that start
/// outside already, a voxel away from their surface.
TEST_F(Gather, BetweenThickWallsIsClosed) {
    // The walls of the room lie 15.06 voxels from the middle; its air is what lies within 12.
    const char* const k_thick = "any(lessThan(v, ivec3(4))) || any(greaterThan(v, ivec3(27))) ? 1.0 : 0.0";
    for (const char* set : {"six", "six_tilted", "spiral"})
        for (bool leaves : {false, true})
            for (const char* aperture : {"5", "60"}) {
                Gathered g = gather(k_thick, leaves, {{"gather.cone_set", set}, {"gather.aperture", aperture}});
                EXPECT_LT(g.open, 0.002) << set << ", " << aperture;
                EXPECT_LT(g.most_open, 0.05) << set << ", " << aperture;
            }
}

/// Thin cones through the voxels of thin walls too.
TEST_F(Gather, ThinConesDoNotLeaveARoomOfOneVoxel) {
    Gathered g = gather("", true, k_tuned);
    EXPECT_LT(g.open, 1e-3);
    EXPECT_LT(g.most_open, 0.1) << "at most one cone of sixteen, next to a corner";
}

TEST_F(Gather, OfAUniformlyLitRoomIsItsRadiance) {
    Gathered g = gather("", true, k_tuned);
    note("as tuned", g);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(g.mean[c] / k_radiance[c], 1, 0.01);
    EXPECT_GT(g.darkest, 0.9) << "a cone of sixteen may start beyond a corner";
    EXPECT_LT(g.brightest, 1.01) << "a mean of what is L at most";
    Sets along = k_tuned; // the same estimator at every sphere on the way
    along[3].second = "false";
    Gathered h = gather("", true, along);
    note("lit fraction on the way", h);
    EXPECT_NEAR(h.mean.r / k_radiance.r, 1, 0.15);
    EXPECT_LT(h.brightest, 1.01);
}

/// From voxel to voxel instead of by thin cones.
TEST_F(Gather, OfAUniformlyLitRoomByExactHitsIsItsRadiance) {
    for (bool leaves : {true, false}) {
        Sets exact = k_tuned;
        exact.insert(exact.end(), {{"gather.exact_hits", "true"}, {"gather.start_offset", "0"}});
        Gathered g = gather("", leaves, exact);
        note(leaves ? "by exact hits" : "the same, isotropic", g);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(g.mean[c] / k_radiance[c], 1, 0.01);
        EXPECT_GT(g.darkest, leaves ? 0.9 : 0.75) << "means know no side: next to a corner they block before its wall";
        EXPECT_LT(g.brightest, 1.01);
        EXPECT_LT(g.open, 2e-3);
    }
}

/// By a walk over the maps: each ray finds the wall itself, corners included.
TEST_F(Gather, OfAUniformlyLitRoomByWalksIsItsRadiance) {
    for (const char* exact : {"false", "true"}) {
        Sets walking = k_tuned;
        walking.insert(walking.end(),
                       {{"gather.hit_lookup", "map"}, {"gather.normal_offset", "0.5"}, {"gather.exact_hits", exact}});
        Gathered g = gather("", true, walking);
        note(std::string(exact) == "true" ? "by walks to exact hits" : "by walks", g);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(g.mean[c] / k_radiance[c], 1, 0.02);
        EXPECT_LT(g.brightest, 1.01);
    }
}

/// As published it loses light (N, V and α all darken): measured, and never more than there is.
TEST_F(Gather, AsPublishedDoesNotGainLight) {
    Gathered g = gather("", false, {});
    note("as published", g);
    RecordProperty("share_of_radiance", fmt::format("{:.4f}", g.mean.r / k_radiance.r));
    EXPECT_GT(g.darkest, 0);
    EXPECT_LT(g.brightest, 1.01);
}
