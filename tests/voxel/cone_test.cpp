// Cones over occlusion voxels that a test fills by hand: the lookup of one sphere against the CPU, and where thin cones
// are blocked.
#include "support/scene_runner.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 32;

/// A scene of 2 m, so that the grid reaches over ±(1 + 1/16) m.
Scene two_metres() {
    return MadeScene().triangle({-1, -1, -1}, {1, 1, -1}, {1, 1, 1}).scene;
}
constexpr double k_side = 2 * (1 + 2.0 / k_resolution);
constexpr double k_voxel = k_side / k_resolution;

/// Independent of the shader's own: a hash of i in [0, 1), the same in GLSL below.
double hashed(uint32_t i) {
    i = (i ^ 61u) ^ (i >> 16);
    i *= 9u;
    i ^= i >> 4;
    i *= 0x27d4eb2du;
    i ^= i >> 15;
    return double(i >> 8) / 16777216.0;
}
const char* const k_hash = R"(
float hashed(uint i) {
    i = (i ^ 61u) ^ (i >> 16);
    i *= 9u;
    i ^= i >> 4;
    i *= 0x27d4eb2du;
    i ^= i >> 15;
    return float(i >> 8) / 16777216.0;
}
)";

/// A room whose walls are one voxel thick, as an expression of `v`.
const char* const k_room =
    "any(equal(v, ivec3(3))) || any(equal(v, ivec3(28))) ? (all(greaterThanEqual(v, ivec3(3))) && "
    "all(lessThanEqual(v, ivec3(28))) ? 1.0 : 0.0) : 0.0";
/// Starts inside it, in all directions.
#define FROM_INSIDE                                                                                                    \
    "vec3 apex = (vec3(hashed(uint(i) * 8u + 2u), hashed(uint(i) * 8u + 3u), hashed(uint(i) * 8u + 4u)) - 0.5) * 1.2;" \
    "vec3 d = on_sphere(i);"

class Cones : public SceneGraphTest {
  protected:
    /// Fills the voxels by an expression of `v` (the voxel in its leaf) and `leaf`, makes mips, and has `body` write
    /// vec4 `result` for each sample `i`.
    std::vector<glm::vec4> samples(int count, const std::string& fill, const std::string& body, bool leaves,
                                   std::vector<std::vector<float>>* mips = nullptr) {
        shader("test/fill.comp", fmt::format(R"(layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(FORMAT_voxels_occlusion) writeonly uniform image3D voxels_occlusion;
{}
void main() {{
    ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(voxels_occlusion);
    if (any(greaterThanEqual(at, size))) return;
    int leaf = at.z / size.x;
    ivec3 v = ivec3(at.xy, at.z % size.x);
    imageStore(voxels_occlusion, at, vec4({}));
}}
)",
                                             k_hash, fill));
        shader("test/sample.comp", fmt::format(R"(#include "voxel/exact_hit.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
{}
vec3 on_sphere(int i) {{
    float z = 2.0 * hashed(uint(i) * 8u) - 1.0, turn = 6.2831853 * hashed(uint(i) * 8u + 1u);
    return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
}}
void main() {{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(test_result).x) return;
    VoxelGrid grid = cone_grid();
    vec4 result = vec4(0.0);
    {}
    imageStore(test_result, ivec2(i, 0), result);
}}
)",
                                               k_hash, body));
        SceneRunner run(
            two_metres(), {},
            graph_file(fmt::format(
                R"("resources":{{"voxels.occlusion":{{"kind":"texture_3d","format":"r8","size":[32,32,{}],"mips":6}},
                                 "test.result":{{"format":"rgba32f","size":[{},1]}}}},
                   "passes":[{{"id":"fill","type":"compute","shader":"test/fill.comp"}},
                    {{"id":"voxel_mips","type":"compute","shader":"voxel/occlusion_mips.comp","params":{{"mip_rule":"{}"}},
                      "bind":{{"voxels.finer":{{"resource":"voxels.occlusion","mip":"iteration - 1"}},
                               "voxels.coarser":{{"resource":"voxels.occlusion","mip":"iteration"}}}},
                      "repeat":{{"over":"mips","of":"voxels.occlusion","from":1}}}},
                    {{"id":"sample","type":"compute","shader":"test/sample.comp"}}])",
                leaves ? 192 : 32, count, leaves ? "along_leaf" : "mean")));
        run.frame();
        if (mips)
            for (int mip = 0; mip < 6; ++mip)
                mips->push_back(run.read("voxels.occlusion", mip));
        std::vector<float> got = run.read("test.result");
        std::vector<glm::vec4> results;
        for (size_t i = 0; i < got.size(); i += 4)
            results.emplace_back(got[i], got[i + 1], got[i + 2], got[i + 3]);
        return results;
    }
};

/// Linear between voxels of one leaf, clamped at its sides.
double lookup(const std::vector<std::vector<float>>& mips, int mip, int leaf, glm::dvec3 at) {
    int size = k_resolution >> mip;
    glm::dvec3 texel = at * double(size) - 0.5;
    glm::ivec3 low(glm::floor(texel));
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        glm::ivec3 v;
        for (int axis = 0; axis < 3; ++axis) {
            int up = (corner >> axis) & 1;
            double share = texel[axis] - low[axis];
            weight *= up ? share : 1 - share;
            v[axis] = std::clamp(low[axis] + up, 0, size - 1);
        }
        sum += weight * mips[size_t(mip)][size_t(((leaf * size + v.z) * size + v.y) * size + v.x)];
    }
    return sum;
}
double lookup(const std::vector<std::vector<float>>& mips, double level, int leaf, glm::dvec3 at) {
    int finer = std::min(int(level), 5), coarser = std::min(finer + 1, 5);
    double share = level - finer;
    return (1 - share) * lookup(mips, finer, leaf, at) + share * lookup(mips, coarser, leaf, at);
}

} // namespace

TEST_F(Cones, ASphereIsTheLinearLookupOfItsMipAndOfItsLeaves) {
    constexpr int k_count = 512;
    for (bool leaves : {false, true}) {
        std::vector<std::vector<float>> mips;
        std::vector<glm::vec4> got = samples(
            k_count, "hashed(uint(((leaf * 32 + v.z) * 32 + v.y) * 32 + v.x)) < 0.2 ? 1.0 : 0.0",
            R"(vec3 position = (vec3(hashed(uint(i) * 8u + 2u), hashed(uint(i) * 8u + 3u), hashed(uint(i) * 8u + 4u)) - 0.5) * 2.1;
               float diameter = 0.03 * exp2(6.0 * hashed(uint(i) * 8u + 5u));
               result = vec4(sphere_occlusion(grid, position, on_sphere(i), sphere_level(grid, diameter)),
                             sphere_level(grid, diameter), 0.0, 0.0);)",
            leaves, &mips);
        double worst = 0;
        int clamped = 0;
        for (uint32_t i = 0; i < k_count; ++i) {
            glm::dvec3 at((hashed(i * 8 + 2) - 0.5) * 2.1, (hashed(i * 8 + 3) - 0.5) * 2.1,
                          (hashed(i * 8 + 4) - 0.5) * 2.1);
            at = at / k_side + 0.5;
            double diameter = 0.03 * std::exp2(6 * hashed(i * 8 + 5));
            double level = std::clamp(std::log2(diameter / k_voxel), 0.0, 5.0);
            EXPECT_NEAR(got[i].y, level, 1e-4);
            double z = 2 * hashed(i * 8) - 1, turn = 6.2831853 * hashed(i * 8 + 1), r = std::sqrt(1 - z * z);
            glm::dvec3 direction(r * std::cos(turn), r * std::sin(turn), z);
            double expected = 0;
            if (leaves) {
                // Near the ends of a leaf the depth is held half a coarser voxel inside.
                double margin = 0.5 * std::exp2(std::ceil(level)) / k_resolution;
                glm::dvec3 held(at.x, at.y, std::clamp(at.z, margin, 1 - margin));
                for (int axis = 0; axis < 3; ++axis)
                    expected += std::abs(direction[axis]) * lookup(mips, level, 2 * axis + (direction[axis] > 0), held);
                clamped += expected > 1;
                expected = std::min(expected, 1.0);
            } else {
                expected = lookup(mips, level, 0, at);
            }
            worst = std::max(worst, std::abs(got[i].x - expected));
        }
        // Filters may weigh with 8 bits: 1/256 for each of three axes and the level, and three leaves of such.
        EXPECT_LT(worst, leaves ? 0.03 : 0.016) << (leaves ? "six leaves" : "isotropic");
        EXPECT_TRUE(!leaves || clamped > 0) << "nothing tests the clamp";
    }
}

/// Wherever it starts and whichever way it goes.
TEST_F(Cones, NothingBlocksInAnEmptyGrid) {
    for (bool leaves : {false, true}) {
        for (
            glm::vec4 result : samples(
                256, "0.0",
                R"(vec3 apex = vec3(hashed(uint(i) * 8u + 2u), hashed(uint(i) * 8u + 3u), hashed(uint(i) * 8u + 4u)) * 2.0 - 1.0;
                    result = vec4(find_hit(grid, apex, on_sphere(i), 0.05, 0.5),
                                  sphere_occlusion(grid, apex, on_sphere(i), 6.0 * hashed(uint(i) * 8u + 5u)),
                                  find_exact_hit(grid, apex, on_sphere(i), 0.0).t, 0.0);)",
                leaves)) {
            EXPECT_LT(result.x, 0);
            EXPECT_EQ(result.y, 0);
            EXPECT_LT(result.z, 0);
        }
    }
}

/// A room one voxel thick: every thin cone from inside is blocked, within a voxel of its wall. Coarser mips are used to
/// cross the empty space: none may carry a cone past the wall.
TEST_F(Cones, EveryThinConeIsBlockedWhereItMeetsAThinWall) {
    for (bool leaves : {false, true}) {
        std::vector<glm::vec4> got = samples(2048, k_room, FROM_INSIDE R"(
               float hit = find_hit(grid, apex, d, 0.01, 0.5);
               vec3 at = abs(apex + hit * d); // the middle of the wall's voxels is 12.5 voxels from the grid's
               result = vec4(hit, max(at.x, max(at.y, at.z)) / grid.voxel - 12.5, grid.voxel, 0.0);)",
                                             leaves);
        int missed = 0;
        double worst = 0;
        for (const glm::vec4& result : got) {
            EXPECT_NEAR(result.z, k_voxel, 1e-6);
            if (result.x < 0) {
                ++missed;
                continue;
            }
            worst = std::max(worst, std::abs(double(result.y)));
        }
        fmt::print("    {}: {} of {} cones missed the wall; hits within {:.2f} voxels of it\n",
                   leaves ? "six leaves" : "isotropic", missed, got.size(), worst);
        EXPECT_EQ(missed, 0);
        // The linear filter reaches a voxel from the middle, and no step is longer than half a voxel where it does.
        EXPECT_LT(worst, 1);
    }
}

/// Exact hits in the same room: all of them, and inside the wall's own voxels.
TEST_F(Cones, EveryExactHitLiesInsideAThinWall) {
    for (bool leaves : {false, true}) {
        std::vector<glm::vec4> got = samples(2048, k_room, FROM_INSIDE R"(
               OccludedAt hit = find_exact_hit(grid, apex, d, 0.0);
               vec3 at = abs(apex + hit.t * d), in_at = abs(apex + hit.enters * d);
               result = vec4(hit.t, max(at.x, max(at.y, at.z)) / grid.voxel, max(in_at.x, max(in_at.y, in_at.z)) / grid.voxel,
                             hit.leaves - hit.enters);)",
                                             leaves);
        for (const glm::vec4& result : got) {
            ASSERT_GE(result.x, 0) << (leaves ? "six leaves" : "isotropic");
            // The wall's voxels lie from 12 to 13 voxels off the grid's middle.
            EXPECT_GT(result.y, 12 - 1e-2);
            EXPECT_LT(result.y, 13 + 1e-2);
            EXPECT_NEAR(result.z, 12, 1e-2) << "where the ray came into the wall";
            EXPECT_GT(result.w, 0);
        }
    }
}

/// A sheet that blocks along x alone is met in the middle of its voxels at every angle; from behind it is not there.
TEST_F(Cones, ExactHitsLieHalfAVoxelDeepAlongTheLeafThatBlocks) {
    std::vector<glm::vec4> got = samples(
        2048, "v.x == 20 && leaf == 1 ? 1.0 : 0.0", // leaf 1 faces −x: it blocks what goes along +x
        R"(vec3 apex = (vec3(hashed(uint(i) * 8u + 2u), hashed(uint(i) * 8u + 3u), hashed(uint(i) * 8u + 4u)) - 0.5) * 0.5;
           vec3 d = on_sphere(i);
           float hit = find_exact_hit(grid, apex, d, 0.0).t;
           vec3 at = (apex + (hit < 0.0 ? 0.0 : hit) * d) / grid.voxel;
           result = vec4(hit, at.x, d.x, 0.0);)",
        true);
    int met = 0;
    for (const glm::vec4& result : got) {
        if (result.x < 0) {
            EXPECT_LT(result.z, 0.5) << "the sheet reaches over the grid: who goes toward it meets it";
            continue;
        }
        ++met;
        EXPECT_GT(result.z, 0) << "met from behind";
        EXPECT_NEAR(result.y, 4.5, 2e-2) << "voxel 20 lies from 4 to 5 voxels off the middle";
    }
    EXPECT_GT(met, 500);
}

/// Whoever goes on from beyond a sheet of voxels meets the next one.
TEST_F(Cones, ExactHitsGoOnFromWhereTheyAreTold) {
    std::vector<glm::vec4> got = samples(
        512, "v.x == 10 || v.x == 24 ? 1.0 : 0.0",
        R"(vec3 d = normalize(vec3(1.0, 0.5 * hashed(uint(i) * 8u + 2u) - 0.25, 0.5 * hashed(uint(i) * 8u + 3u) - 0.25));
           vec3 apex = vec3(-0.9, 0.0, 0.0);
           float first = find_exact_hit(grid, apex, d, 0.0).t;
           float second = find_exact_hit(grid, apex, d, first + 2.0 * grid.voxel).t;
           float third = find_exact_hit(grid, apex, d, second + 2.0 * grid.voxel).t;
           result = vec4((apex + first * d).x, (apex + second * d).x, third, grid.voxel);)",
        false);
    for (const glm::vec4& result : got) {
        EXPECT_GT(result.x / result.w, -6.01);
        EXPECT_LT(result.x / result.w, -4.99);
        EXPECT_GT(result.y / result.w, 7.99);
        EXPECT_LT(result.y / result.w, 9.01);
        EXPECT_LT(result.z, 0);
    }
}
