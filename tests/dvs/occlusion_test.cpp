// Which voxels a light reaches: shadow map with its shift, hard and soft rays, several lights, emission; soft shadow
// cones and how the base volume is blended in at the pixel.
#include "support/scene_runner.h"
#include "voxel/voxel_grid.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 32;
using Sets = std::vector<std::pair<std::string, std::string>>;

const char* const k_graph =
    R"("passes":[{"type":"shadow_maps","params":{"resolution":512}},
        {"type":"voxelization","params":{"resolution":32,"averaging":"sum","route":"compute"}},
        {"type":"voxel_direct"},
        {"id":"filter","type":"voxel_filter","bind":{"dvs.filtered":"dvs.radiance","dvs.finer":"dvs.directional"}}])";

/// A floor under a plate.
Scene floor_and_plate() {
    return MadeScene()
        .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.8f, 0.6f, 0.4f})
        .quad({-0.41f, 0.73f, 0.37f}, {0.43f, 0.73f, 0.37f}, {0.43f, 0.73f, -0.39f}, {-0.41f, 0.73f, -0.39f},
              {0.5f, 0.5f, 0.5f})
        .scene;
}

class VoxelOcclusion : public SceneGraphTest {
  protected:
    struct Volumes {
        explicit Volumes(const SceneRunner& run)
            : grid(run.facts.bounds_over_animation, k_resolution), radiance(run.read("dvs.radiance")),
              albedo(run.read("voxels.albedo")), normal(run.read("voxels.normal")) {}
        VoxelGrid grid;
        std::vector<float> radiance, albedo, normal;
        static glm::ivec3 voxel(int i) {
            return {i % k_resolution, i / k_resolution % k_resolution, i / k_resolution / k_resolution};
        }
        static int index(glm::ivec3 p) { return p.x + k_resolution * (p.y + k_resolution * p.z); }
        bool occupied(glm::ivec3 p) const { return albedo[4 * size_t(index(p)) + 3] > 0; }
        glm::dvec3 centre(glm::ivec3 p) const {
            return glm::dvec3(grid.origin) + (glm::dvec3(p) + 0.5) * double(grid.voxel_size());
        }
        double red(glm::ivec3 p) const { return radiance[4 * size_t(index(p))]; }
    };
    static constexpr int k_all = k_resolution * k_resolution * k_resolution;
};

struct LightCase {
    const char* name;
    Light light;
    bool far;
};
std::vector<LightCase> light_cases() {
    return {{"directional", directional_light({-0.2f, -1, 0.1f}, {3, 3, 3}), true},
            {"spot", spot_light({0.2f, 2.6f, -0.1f}, {-0.05f, -1, 0}, {20, 20, 20}, 60, 70), false},
            {"point", point_light({-0.3f, 2.3f, 0.2f}, {20, 20, 20}), false}};
}

} // namespace

/// Floor voxels whose ray to the light meets the plate well inside are dark, well outside lit, by map and by ray.
TEST_F(VoxelOcclusion, DarkensWhatThePlateCovers) {
    for (const LightCase& kind : light_cases()) {
        for (const char* occlusion : {"shadow_map", "ray_hard"}) {
            SceneRunner free(floor_and_plate(), {kind.light}, graph_file(k_graph),
                             {{"voxel_direct.occlusion", "none"}});
            SceneRunner run(floor_and_plate(), {kind.light}, graph_file(k_graph),
                            {{"voxel_direct.occlusion", occlusion}});
            free.frame();
            run.frame();
            Volumes lit(free), seen(run);
            double voxel = seen.grid.voxel_size();
            int dark = 0, bright = 0;
            for (int i = 0; i < VoxelOcclusion::k_all; ++i) {
                glm::ivec3 p = Volumes::voxel(i);
                if (!seen.occupied(p) || seen.centre(p).y > 0.3 || lit.red(p) < 0.02) continue;
                glm::dvec3 from = seen.centre(p);
                glm::dvec3 l = kind.far ? -glm::dvec3(kind.light.direction) : glm::dvec3(kind.light.position) - from;
                glm::dvec3 at = from + l * ((0.73 - from.y) / l.y);
                double inside = std::min(std::min(at.x + 0.41, 0.43 - at.x), std::min(at.z + 0.39, 0.37 - at.z));
                if (inside > 1.5 * voxel) {
                    EXPECT_EQ(seen.red(p), 0) << kind.name << ", " << occlusion;
                    ++dark;
                } else if (inside < -1.5 * voxel) {
                    EXPECT_EQ(seen.red(p), lit.red(p)) << kind.name << ", " << occlusion;
                    ++bright;
                }
            }
            EXPECT_GT(dark, 30) << kind.name << ", " << occlusion;
            EXPECT_GT(bright, 300) << kind.name << ", " << occlusion;
        }
    }
}

/// A slanted plane: half of its voxels have their centre below it, in its own shadow, unless they are moved along the
/// normal. Where V_p + s·V_size·N lies tells which are lit.
TEST_F(VoxelOcclusion, MovesVoxelsAlongTheirNormal) {
    Scene plane =
        MadeScene().quad({-1, -0.37f, 1}, {1, 0.29f, 1}, {1, 0.29f, -1}, {-1, -0.37f, -1}, {0.7f, 0.7f, 0.7f}).scene;
    glm::dvec3 n = glm::normalize(glm::dvec3(-0.66, 2, 0)), l = glm::normalize(glm::dvec3(0.3, 1, 0.2));
    int dark_before = 0;
    for (double shift : {0.0, 0.5, 1.0}) {
        SceneRunner run(plane, {directional_light(glm::vec3(-l), {3, 3, 3})}, graph_file(k_graph),
                        {{"voxel_direct.shadow_shift", fmt::format("{}", shift)}});
        run.frame();
        Volumes seen(run);
        int lit = 0, dark = 0;
        double texel = 3.0 / 512; // metres across the map, at most; the plane is hardly steeper than 45° to it
        for (int i = 0; i < VoxelOcclusion::k_all; ++i) {
            glm::ivec3 p = Volumes::voxel(i);
            if (!seen.occupied(p)) continue;
            // Beyond the plane's rim there is nothing in the map.
            glm::dvec3 moved = seen.centre(p) + shift * double(seen.grid.voxel_size()) * n;
            if (std::max(std::abs(moved.x), std::abs(moved.z)) > 0.9) continue;
            double above = glm::dot(moved - glm::dvec3(1, 0.29, 1), n);
            if (std::abs(above) < 2 * texel) continue;
            EXPECT_EQ(seen.red(p) > 0, above > 0) << "shift " << shift;
            (seen.red(p) > 0 ? lit : dark) += 1;
        }
        EXPECT_GT(lit, 200);
        fmt::print("    shift {}: {} voxels lit, {} in their own shadow\n", shift, lit, dark);
        if (shift == 0) {
            EXPECT_GT(dark, 200);
        } else if (shift == 0.5) {
            EXPECT_LT(dark, dark_before / 4);
        } else {
            EXPECT_EQ(dark, 0);
        }
        dark_before = dark;
    }
}

/// ν ← ν + (1 − ν)·κ/t for each step that lands in a voxel, on the CPU over the flags that were read back.
TEST_F(VoxelOcclusion, SoftRaysAddKappaOverDistance) {
    const double kappa = 0.7, start = 1.5, step = 1;
    for (const LightCase& kind : light_cases()) {
        SceneRunner free(floor_and_plate(), {kind.light}, graph_file(k_graph), {{"voxel_direct.occlusion", "none"}});
        SceneRunner run(floor_and_plate(), {kind.light}, graph_file(k_graph),
                        {{"voxel_direct.occlusion", "ray_soft"},
                         {"voxel_direct.kappa", "0.7"},
                         {"voxel_direct.ray_start", "1.5"},
                         {"voxel_direct.ray_step", "1"}});
        free.frame();
        run.frame();
        Volumes lit(free), seen(run);
        double voxel = seen.grid.voxel_size();
        int compared = 0, partly = 0, off = 0;
        for (int i = 0; i < VoxelOcclusion::k_all; ++i) {
            glm::ivec3 p = Volumes::voxel(i);
            if (!seen.occupied(p) || lit.red(p) < 0.02) continue;
            glm::dvec3 to = glm::dvec3(kind.light.position) - seen.centre(p);
            glm::dvec3 l = kind.far ? -glm::dvec3(kind.light.direction) : glm::normalize(to);
            double end = kind.far ? 2.0 * k_resolution : std::min(glm::length(to) / voxel - 1, 2.0 * k_resolution);
            double occluded = 0;
            for (double t = start; t < end; t += step) {
                glm::dvec3 at = glm::dvec3(p) + 0.5 + t * l;
                if (glm::any(glm::lessThan(at, glm::dvec3(0))) ||
                    glm::any(glm::greaterThanEqual(at, glm::dvec3(k_resolution))))
                    break;
                if (seen.occupied(glm::ivec3(at))) occluded += (1 - occluded) * std::min(kappa / t, 1.0);
            }
            ++compared;
            partly += occluded > 0;
            off += std::abs(seen.red(p) - (1 - occluded) * lit.red(p)) > 0.002 * lit.red(p) + 1e-4;
        }
        EXPECT_GT(compared, 800) << kind.name;
        EXPECT_GT(partly, 50) << kind.name;
        EXPECT_LE(off, compared / 100) << kind.name; // steps that land on a border, in single precision
    }
}

TEST_F(VoxelOcclusion, LightsAddUpAndSoDoesEmission) {
    std::vector<LightCase> kinds = light_cases();
    auto radiance = [&](const std::vector<Light>& lights, float emitted) {
        MadeScene made;
        made.scene = floor_and_plate();
        made.scene.materials[1].emission = glm::vec3(emitted, 0.5f * emitted, 0);
        SceneRunner run(made.scene, lights, graph_file(k_graph));
        run.frame();
        EXPECT_EQ(run.graph.plan().find_resource("voxels.emission") != nullptr, emitted > 0);
        return run.read("dvs.radiance");
    };
    std::vector<float> all = radiance({kinds[0].light, kinds[1].light, kinds[2].light}, 0.25f);
    std::vector<float> emission = radiance({}, 0.25f);
    std::vector<std::vector<float>> parts{emission};
    for (const LightCase& kind : kinds)
        parts.push_back(radiance({kind.light}, 0));
    int lit = 0, glowing = 0;
    for (size_t i = 0; i < all.size(); i += 4) {
        for (size_t k = 0; k < 3; ++k) {
            double sum = 0;
            for (const std::vector<float>& part : parts)
                sum += part[i + k];
            ASSERT_NEAR(all[i + k], sum, 0.002 * sum + 1e-4);
        }
        lit += parts[1][i] > 0.05f && parts[2][i] > 0.05f;
        glowing += std::abs(emission[i] - 0.25f) < 0.002f && std::abs(emission[i + 1] - 0.125f) < 0.002f;
    }
    EXPECT_GT(lit, 300);
    EXPECT_GT(glowing, 100);
}

/// Between the base volume and the first directional level the look-up goes linearly, by the level.
TEST_F(VoxelOcclusion, TheBaseVolumeIsBlendedInBelowTheFirstLevel) {
    shader("test/fill.comp", R"(layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(FORMAT_test_volume) writeonly uniform image3D test_volume;
uniform float red = 0.0; //! [0, 1] of it
void main() {
    if (all(lessThan(ivec3(gl_GlobalInvocationID), imageSize(test_volume))))
        imageStore(test_volume, ivec3(gl_GlobalInvocationID), vec4(red, 1.0 - red, 0.0, 0.5 + 0.25 * red));
}
)");
    shader("test/levels.comp", R"(#include "dvs/cone.glsl"
layout(local_size_x = 8) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= 5) return;
    vec3 middle = 0.5 * (scene_min + scene_max);
    imageStore(test_result, ivec2(i, 0), sphere_value(cone_grid(), middle, normalize(vec3(1.0, 2.0, -3.0)), 0.375 * float(i)));
}
)");
    SceneRunner run(floor_and_plate(), {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(R"("resources":{
        "dvs.base":{"kind":"texture_3d","format":"rgba16f","size":[32,32,32]},
        "dvs.directional":{"kind":"texture_3d","format":"rgba16f","size":[32,48,16]},
        "test.result":{"format":"rgba32f","size":[5,1]}},
        "passes":[{"type":"voxelization","params":{"resolution":32,"averaging":"sum"}},
        {"id":"fill","type":"compute","shader":"test/fill.comp","params":{"red":1},"bind":{"test.volume":"dvs.base"}},
        {"id":"fill_directional","type":"compute","shader":"test/fill.comp","bind":{"test.volume":"dvs.directional"}},
        {"id":"levels","type":"compute","shader":"test/levels.comp","dispatch":[5,1,1]}])"));
    run.frame();
    std::vector<float> got = run.read("test.result");
    for (size_t i = 0; i < 5; ++i) {
        double level = std::min(0.375 * double(i), 1.0);
        EXPECT_NEAR(got[4 * i], 1 - level, 0.002);
        EXPECT_NEAR(got[4 * i + 1], level, 0.002);
        EXPECT_NEAR(got[4 * i + 3], 0.75 - 0.25 * level, 0.002);
    }
}

/// From above: floor in the plate's umbra is nearly dark, floor far from it is lit, and a wider cone is softer.
TEST_F(VoxelOcclusion, ShadowConesDarkenUnderThePlate) {
    std::string all(k_graph), passes = all.substr(0, all.size() - 1); // without the closing bracket
    std::string graph =
        R"("resources":{"voxels.light_visibility":{"kind":"texture_2d_array","format":"r8","size":[64,64,1]}},)" +
        passes +
        R"(,{"type":"gbuffer"},
        {"id":"shadow_cones","type":"compute","shader":"dvs/shadow_cones.comp","bind":{"dvs.base":"dvs.radiance"}}])";
    double partly[2] = {0, 0};
    for (int wide : {0, 1}) {
        SceneRunner run(floor_and_plate(), {directional_light({0, -1, 0}, {3, 3, 3})}, graph_file(graph),
                        {{"shadow_cones.aperture", wide ? "30" : "3"}}, {64, 64});
        // From below the plate's height, so that all of the floor under it is seen.
        run.camera.position = {0, 0.6f, 2.6f};
        run.camera.target = {0, 0, 0};
        run.frame();
        std::vector<float> open = run.read("voxels.light_visibility"), depth = run.read("gbuffer.depth");
        int dark = 0, bright = 0;
        for (size_t i = 0; i < open.size(); ++i) {
            if (depth[i] <= 0) continue;
            dark += open[i] < 0.25f;
            bright += open[i] > 0.9f;
            partly[wide] += open[i] >= 0.25f && open[i] <= 0.9f;
        }
        EXPECT_GT(dark, 20) << (wide ? 30 : 3);
        // A wide cone over the published volumes is darkened by the floor that it starts from.
        if (!wide) {
            EXPECT_GT(bright, 200);
        }
    }
    EXPECT_GT(partly[1], 1.5 * partly[0]);
}
