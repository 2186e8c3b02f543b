// Light at voxels against the CPU: direct light (Eq. 2 and Eq. 3–5), the directional mips, one bounce between two
// plates, and cones through a homogeneous medium.
#include "support/scene_runner.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 32;
constexpr float k_pi = 3.14159265f;

std::string graph_of(const std::string& direct, const std::string& filter) {
    return R"("passes":[{"type":"voxelization","params":{"resolution":32,"averaging":"sum"}},
        {"type":"voxel_direct","params":{"occlusion":"none")" +
           direct + R"(}},
        {"id":"filter","type":"voxel_filter","params":{)" +
           filter + R"(},"bind":{"dvs.filtered":"dvs.radiance","dvs.finer":"dvs.directional"}}])";
}

Scene tilted() {
    return MadeScene()
        .quad({-1, -0.8f, 1}, {1, -0.3f, 1}, {1, 0.2f, -1}, {-1, -0.3f, -1}, {0.6f, 0.5f, 0.4f})
        .box({-0.5f, 0.3f, -0.5f}, {0.3f, 0.9f, 0.2f}, {0.2f, 0.7f, 0.9f})
        .scene;
}

class VoxelLight : public SceneGraphTest {};

using Eight = std::array<glm::dvec4, 8>;

/// Front to back along the leaf's axis, then the mean of the four columns.
glm::dvec4 directional_mean(const Eight& children, int leaf) {
    glm::dvec4 sum(0);
    int axis = leaf / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
            int column = (a << u) | (b << v);
            glm::dvec4 low = children[size_t(column)], high = children[size_t(column | (1 << axis))];
            glm::dvec4 near = leaf % 2 == 0 ? high : low, far = leaf % 2 == 0 ? low : high;
            sum += near + (1 - near.a) * far;
        }
    return sum / 4.0;
}

struct Volume {
    std::vector<float> texels;
    glm::ivec3 size;
    glm::dvec4 at(glm::ivec3 p) const {
        const float* t = &texels[4 * (size_t(p.x) + size_t(size.x) * (size_t(p.y) + size_t(size.y) * size_t(p.z)))];
        return {t[0], t[1], t[2], t[3]};
    }
};
Volume volume(const SceneRunner& run, const std::string& name, int mip = 0) {
    return {run.read(name, mip), mip_size(run.texture(name).desc(), mip)};
}

/// Every texel of `coarser` against the mean of its children; returns the greatest difference.
double worst_step(const Volume& finer, bool finer_has_tiles, const Volume& coarser, int* nonzero = nullptr) {
    int size = coarser.size.z;
    double worst = 0;
    for (int leaf = 0; leaf < 6; ++leaf)
        for (int i = 0; i < size * size * size; ++i) {
            glm::ivec3 p(i % size, i / size % size, i / size / size);
            glm::ivec3 tile(leaf & 1, leaf / 2, 0);
            Eight children;
            for (int k = 0; k < 8; ++k)
                children[size_t(k)] = finer.at(2 * p + glm::ivec3(k & 1, (k >> 1) & 1, k >> 2) +
                                               (finer_has_tiles ? tile * (2 * size) : glm::ivec3(0)));
            glm::dvec4 wanted = directional_mean(children, leaf), got = coarser.at(p + tile * size);
            glm::dvec4 off = glm::abs(wanted - got) / glm::max(glm::abs(wanted), glm::dvec4(0.01));
            worst = std::max({worst, off.x, off.y, off.z, off.w});
            if (nonzero) *nonzero += got.a > 0;
        }
    return worst;
}

} // namespace

TEST_F(VoxelLight, IsLambertOrNormalWeighted) {
    glm::vec3 l = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
    for (bool weighted : {false, true}) {
        SceneRunner run(tilted(), {directional_light(-l, {3, 2, 1})},
                        graph_file(graph_of(weighted ? R"(,"attenuation":"normal_weighted")" : "", "")));
        run.frame();
        Volume radiance = volume(run, "dvs.radiance"), albedo = volume(run, "voxels.albedo"),
               normal = volume(run, "voxels.normal");
        int lit = 0;
        for (int i = 0; i < k_resolution * k_resolution * k_resolution; ++i) {
            glm::ivec3 p(i % k_resolution, i / k_resolution % k_resolution, i / k_resolution / k_resolution);
            glm::dvec4 got = radiance.at(p);
            if (albedo.at(p).a == 0) {
                EXPECT_EQ(got, glm::dvec4(0));
                continue;
            }
            glm::dvec3 averaged(normal.at(p));
            if (glm::length(averaged) < 0.06) continue;
            glm::dvec3 n = glm::normalize(averaged);
            double cosine = std::max(glm::dot(n, glm::dvec3(l)), 0.0);
            if (weighted) {
                cosine = 0;
                for (int k = 0; k < 3; ++k) {
                    double d = averaged[k] > 0 ? std::max(double(l[k]), 0.0) : std::max(-double(l[k]), 0.0);
                    cosine += averaged[k] * averaged[k] * d;
                }
            }
            glm::dvec3 wanted = glm::dvec3(3, 2, 1) * glm::dvec3(albedo.at(p)) * (cosine / k_pi);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(got[k], wanted[k], 0.002 + 0.002 * wanted[k]) << (weighted ? "Eq. 5" : "Eq. 2");
            lit += wanted.x > 0.01;
        }
        EXPECT_GT(lit, 500);
    }
}

TEST_F(VoxelLight, FallsWithTheSquareOfTheDistance) {
    SceneRunner run(tilted(), {point_light({0.1f, 2.5f, 0.4f}, {3, 3, 3})}, graph_file(graph_of("", "")));
    run.frame();
    Volume radiance = volume(run, "dvs.radiance"), albedo = volume(run, "voxels.albedo"),
           normal = volume(run, "voxels.normal");
    const Bounds& bounds = run.facts.bounds_over_animation;
    glm::dvec3 edge = bounds.size();
    double side = std::max({edge.x, edge.y, edge.z}) * (1 + 2.0 / k_resolution);
    glm::dvec3 origin = glm::dvec3(bounds.centre()) - 0.5 * side;
    int lit = 0;
    for (int i = 0; i < k_resolution * k_resolution * k_resolution; ++i) {
        glm::ivec3 p(i % k_resolution, i / k_resolution % k_resolution, i / k_resolution / k_resolution);
        if (albedo.at(p).a == 0 || glm::length(glm::dvec3(normal.at(p))) < 0.06) continue;
        glm::dvec3 centre = origin + (glm::dvec3(p) + 0.5) * (side / k_resolution);
        glm::dvec3 to = glm::dvec3(0.1, 2.5, 0.4) - centre;
        double cosine = std::max(glm::dot(glm::normalize(glm::dvec3(normal.at(p))), glm::normalize(to)), 0.0);
        double wanted = 3 / glm::dot(to, to) * albedo.at(p).x * cosine / k_pi;
        EXPECT_NEAR(radiance.at(p).x, wanted, 0.001 + 0.004 * wanted);
        lit += wanted > 0.01;
    }
    EXPECT_GT(lit, 300);
}

TEST_F(VoxelLight, DirectionalMipsAreFrontToBackThenMeans) {
    for (bool leaves : {false, true}) {
        SceneRunner run(
            tilted(), {directional_light({-0.3f, -0.8f, -0.5f}, {3, 2, 1})},
            graph_file(graph_of(leaves ? R"(,"two_sided":true)" : "", leaves ? R"("directional_leaves":true)" : "")));
        run.frame();
        int mips = run.texture("dvs.directional").desc().mips, nonzero = 0;
        EXPECT_EQ(mips, leaves ? 6 : 5);
        if (!leaves) {
            EXPECT_LT(worst_step(volume(run, "dvs.radiance"), false, volume(run, "dvs.directional"), &nonzero), 0.003);
            EXPECT_GT(nonzero, 1000);
        }
        for (int mip = 1; mip < mips; ++mip)
            EXPECT_LT(worst_step(volume(run, "dvs.directional", mip - 1), true, volume(run, "dvs.directional", mip)),
                      0.003)
                << "mip " << mip;
    }
}

/// Isotropic: every direction is the mean of the eight.
TEST_F(VoxelLight, MeanMipsKnowNoDirection) {
    SceneRunner run(tilted(), {directional_light({-0.3f, -0.8f, -0.5f}, {3, 2, 1})},
                    graph_file(graph_of("", R"("mip_rule":"mean")")));
    run.frame();
    Volume base = volume(run, "dvs.radiance"), first = volume(run, "dvs.directional");
    int held = 0;
    for (int i = 0; i < 16 * 16 * 16; ++i) {
        glm::ivec3 p(i % 16, i / 16 % 16, i / 256);
        glm::dvec4 mean(0);
        for (int k = 0; k < 8; ++k)
            mean += 0.125 * base.at(2 * p + glm::ivec3(k & 1, (k >> 1) & 1, k >> 2));
        held += mean.a > 0;
        for (int leaf = 0; leaf < 6; ++leaf)
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(first.at(p + 16 * glm::ivec3(leaf & 1, leaf / 2, 0))[c], mean[c], 0.001 + 0.002 * mean[c]);
    }
    EXPECT_GT(held, 300);
}

/// Two facing squares; the lower one is lit from above, through the upper one. The centre of the upper one sees the
/// lower one with E = π·L·F, F the form factor from a point to four rectangles of w × w at distance h, with x = w/h:
///   F = (4/π)·x/√(1 + x²)·atan(x/√(1 + x²)).
/// In voxels: plates reach 16 voxels from the middle (their border lies in the outermost voxels); the apex lies one
/// voxel below the centre of voxel 23, and the lower plate's voxels end at 9.
TEST_F(VoxelLight, BouncesOnceBetweenTwoPlates) {
    Scene scene = MadeScene()
                      .quad({-1, -0.5f, 1}, {1, -0.5f, 1}, {1, -0.5f, -1}, {-1, -0.5f, -1}, {0.8f, 0.8f, 0.8f})
                      .quad({-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.5f, 1}, {-1, 0.5f, 1}, {0.5f, 0.5f, 0.5f})
                      .scene;
    double ratio = 16 / (22.5 - 9), across = ratio / std::sqrt(1 + ratio * ratio);
    double form = 4 / double(k_pi) * across * std::atan(across);
    double lower = 0.8 / k_pi * 10, wanted = 0.5 * lower * form;
    auto bounced = [&](const std::string& params, const std::string& planes = "false", glm::vec3 sky = glm::vec3(0)) {
        SceneRunner run(
            scene, {directional_light({0, -1, 0}, {10, 10, 10})},
            graph_file(
                R"("passes":[{"type":"voxelization","params":{"resolution":32,"averaging":"sum","planes":)" + planes +
                R"(}},
                {"type":"voxel_direct","params":{"occlusion":"none","two_sided":true}},
                {"id":"filter","type":"voxel_filter","params":{"directional_leaves":true},
                 "bind":{"dvs.filtered":"dvs.radiance","dvs.finer":"dvs.directional"}},
                {"type":"voxel_bounce","params":{)" +
                params +
                R"(},"bind":{"dvs.base":"dvs.radiance","dvs.filtered":"dvs.bounced","dvs.finer":"dvs.directional"}}])"));
        if (sky != glm::vec3(0)) run.set_environment(sky);
        run.frame();
        Volume all = volume(run, "dvs.bounced"), albedo = volume(run, "voxels.albedo");
        double sum = 0, count = 0;
        for (int z = 14; z < 18; ++z)
            for (int x = 14; x < 18; ++x)
                for (int y = 18; y < 28; ++y)
                    if (albedo.at({x, y, z}).a > 0) sum += all.at({x, y, z}).x, ++count;
        EXPECT_GT(count, 0);
        return sum / count;
    };
    double from_sky = bounced(
        R"("bounces":1,"sky_light":true,"hit_then_sample":true,"exact_hits":true,"cone_set":"spiral","spiral_cones":64)",
        "false", {2, 2, 2});
    EXPECT_NEAR(from_sky, 0.5 * 2 * (1 - form), 0.05) << "what the lower plate leaves open, and nothing of its light";
    double exact = bounced(R"("hit_then_sample":true,"exact_hits":true,"cone_set":"spiral","spiral_cones":64)");
    double wide = bounced(R"("cone_set":"spiral","spiral_cones":64,"aperture":15,"direction_weights":"absolute")");
    fmt::print("    bounced {:.4f} by exact hits, {:.4f} by cones, {:.4f} in closed form\n", exact, wide, wanted);
    EXPECT_NEAR(exact, wanted, 0.05 * wanted);
    EXPECT_NEAR(wide, wanted, 0.15 * wanted);
    // With planes the plates are where they are: y = ±½ at voxels 23.53 and 8.47, the apex one below.
    ratio = 16 / (22.53 - 8.47), across = ratio / std::sqrt(1 + ratio * ratio);
    wanted = 0.5 * lower * 4 / double(k_pi) * across * std::atan(across);
    double plane = bounced(R"("hit_then_sample":true,"exact_hits":true,"cone_set":"spiral","spiral_cones":64)", "true");
    fmt::print("    {:.4f} by hits of planes, {:.4f} in closed form\n", plane, wanted);
    EXPECT_NEAR(plane, wanted, 0.02 * wanted);
}

/// A medium that is the same everywhere, α and L: after n steps front to back, α_n = 1 − (1 − α)^n and c = L·α_n; the
/// ambient occlusion is 1 − (1 − α·f)^n with f = 1/(1 + λ·r).
TEST_F(VoxelLight, ConesGatherFrontToBack) {
    shader("test/fill.comp", R"(layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(FORMAT_test_volume) writeonly uniform image3D test_volume;
void main() {
    if (all(lessThan(ivec3(gl_GlobalInvocationID), imageSize(test_volume))))
        imageStore(test_volume, ivec3(gl_GlobalInvocationID), vec4(0.25 * vec3(0.5, 1.0, 2.0), 0.25));
}
)");
    shader("test/cones.comp", R"(#include "dvs/cone.glsl"
layout(local_size_x = 8) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
void main() {
    if (gl_GlobalInvocationID.x >= 4u) return;
    int i = int(gl_GlobalInvocationID.x);
    vec3 direction = normalize(vec3(float(i & 1) - 0.5, 0.3, float(i >> 1) - 0.4));
    Traced cone = trace_cone(cone_grid(), 0.5 * (scene_min + scene_max), direction, 0.001, 0.0);
    imageStore(test_result, ivec2(i, 0), vec4(cone.colour.gb, cone.occlusion, cone.ambient_occlusion));
}
)");
    for (int tile : {16, 32}) {
        for (int steps : {1, 5}) {
            std::string half = std::to_string(tile),
                        graph = fmt::format(
                            R"("resources":{{"dvs.base":{{"kind":"texture_3d","format":"rgba16f","size":[32,32,32]}},
                "dvs.directional":{{"kind":"texture_3d","format":"rgba16f","size":[{0},{1},{2}]}},
                "voxels.flags":{{"kind":"texture_3d","format":"r8ui","size":[32,32,32]}},
                "voxels.bricks":{{"kind":"texture_3d","format":"r8ui","size":[8,8,8]}},
                "voxels.normal":{{"kind":"texture_3d","format":"rgba8_snorm","size":[32,32,32]}},
                "test.result":{{"format":"rgba32f","size":[4,1]}}}},
                "passes":[{{"type":"voxelization","params":{{"resolution":32,"averaging":"sum"}}}},
                {{"id":"fill","type":"compute","shader":"test/fill.comp","bind":{{"test.volume":"dvs.base"}}}},
                {{"id":"fill_directional","type":"compute","shader":"test/fill.comp","bind":{{"test.volume":"dvs.directional"}}}},
                {{"id":"cones","type":"compute","shader":"test/cones.comp","dispatch":[4,1,1],
                  "params":{{"max_steps":{3},"cone_step":1,"ambient_decay":0.4,"direction_weights":"squared"}}}}])",
                            2 * tile, 3 * tile, tile, steps);
            SceneRunner run(tilted(), {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(graph));
            run.frame();
            std::vector<float> got = run.read("test.result");
            double alpha = 1 - std::pow(0.75, steps), ambient = 1 - std::pow(1 - 0.25 / (1 + 0.4 * 0.5), steps);
            for (size_t i = 0; i < 4; ++i) {
                EXPECT_NEAR(got[4 * i], 1.0 * alpha, 0.002) << steps << " steps, tiles of " << tile;
                EXPECT_NEAR(got[4 * i + 1], 2.0 * alpha, 0.004);
                EXPECT_NEAR(got[4 * i + 2], alpha, 0.002);
                EXPECT_NEAR(got[4 * i + 3], ambient, 0.002);
            }
        }
    }
}
