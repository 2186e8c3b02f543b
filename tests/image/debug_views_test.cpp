// The debug views show what is there: cubes against a search through all voxels, slices and mosaics against the texels,
// the recorded cones against the gather.
#include "app/session.h"
#include "image/cubes_oracle.h"
#include "lrsm/cone_record.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <cstring>
#include <gmock/gmock.h>

using namespace bounce;

namespace {

class DebugViews : public GpuTest {
  protected:
    void open(const std::string& graph, std::vector<std::pair<std::string, std::string>> sets,
              std::vector<std::string> passes) {
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
            .quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1, -1}, {-1, 1, 1}, {0.8f, 0.2f, 0.1f})
            .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f})
            .write(folder.path(), "tiny");
        SessionOptions options;
        options.shot = write_shot(
            folder.path(), "tiny", "tiny.gltf", {1.4f, 1.1f, 2.4f}, {0, 0.2f, 0},
            R"({"type":"spot","position":[0.5,2,0.5],"direction":[-0.2,-1,-0.2],"intensity":4,"outer_cone_deg":40},)"
            R"({"type":"directional","direction":[-0.7,-1,-0.2],"intensity":1})");
        options.graph = graph;
        options.size = {48, 40};
        options.sets = {{"occlusion_voxels.resolution", "32"}, {"rsm.resolution", "64"}};
        options.sets.insert(options.sets.end(), sets.begin(), sets.end());
        for (const std::string& pass : passes)
            options.switches.emplace_back(pass, true);
        session = std::make_unique<Session>(options);
        render();
    }
    void set(const std::string& name, const std::string& text) {
        session->set_parameter(name, text, ParameterOrigin::panel);
    }
    void render() {
        session->render();
        for (const GraphProblem& problem : session->graph().problems())
            ADD_FAILURE() << problem.error.text();
    }
    const GpuTexture& texture(const std::string& name) const { return *session->graph().texture(name); }
    /// α of a voxel at a mip; leaf 0: the greatest of all.
    float alpha(const std::vector<float>& voxels, int side, int leaves, glm::ivec3 v, int leaf) const {
        float most = 0;
        for (int l = 0; l < leaves; ++l)
            if (leaf == 0 || leaf == l + 1)
                most = std::max(most, voxels[size_t(v.x + side * (v.y + side * (v.z + side * l)))]);
        return most;
    }

    TempFolder folder;
    std::unique_ptr<Session> session;
};

glm::vec3 rgb(const std::vector<float>& texels, size_t at) {
    return {texels[4 * at], texels[4 * at + 1], texels[4 * at + 2]};
}

float luminance_free_error(glm::vec3 a, glm::vec3 b) {
    glm::vec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

/// What the cube view makes of α.
glm::vec3 heat_colour(float alpha) {
    return glm::clamp(glm::vec3(2 * alpha - 0.6f, 1.4f - 2.4f * std::abs(alpha - 0.5f), 1.2f - 2 * alpha), 0.1f, 1.0f);
}

} // namespace

TEST_F(DebugViews, AreOffAndCostNothingUntilAskedFor) {
    for (const char* graph : {"lrsm", "lrsm_tuned"}) {
        open(graph, {{"gather.max_steps", "1"}}, {});
        for (const std::string& name : session->graph().plan().resource_names())
            EXPECT_FALSE(name.starts_with("debug.")) << graph << " makes " << name;
        const GraphModel& model = session->graph().model();
        EXPECT_THAT(model.off_for("debug.cones_view"), testing::UnorderedElementsAre("inspect", "view_cones"));
        EXPECT_THAT(model.off_for("debug.voxels"), testing::ElementsAre("view_cubes"));
        EXPECT_THAT(model.off_for("out.display"), testing::IsEmpty());
        session->graph().model().switch_pass("view_cones", true);
        EXPECT_TRUE(model.find_node("inspect")->enabled);
        EXPECT_THROW(session->graph().model().switch_pass("veiw_cones", true), Error);
    }
}

/// The nearest box among all voxels that hold something is the one that the ray's walk ends at.
TEST_F(DebugViews, CubesAreTheNearestVoxels) {
    open("lrsm_tuned", {{"gather.max_steps", "1"}, {"view_cubes.edges", "0"}}, {"view_cubes"});
    const FrameConstants& c = session->constants();
    VoxelGrid grid(session->facts().bounds_over_animation, 32);
    struct Case {
        int mip, leaf;
        const char* leaf_name;
    };
    for (Case wanted : {Case{0, 0, "any"}, Case{2, 0, "any"}, Case{0, 3, "y"}}) {
        set("view_cubes.mip", std::to_string(wanted.mip));
        set("view_cubes.leaf", wanted.leaf_name);
        render();
        std::vector<float> shown = texture("debug.voxels").read(),
                           voxels = texture("voxels.occlusion").read(wanted.mip);
        int side = 32 >> wanted.mip;
        std::vector<DrawnCube> cubes;
        for (int i = 0; i < side * side * side; ++i) {
            glm::ivec3 v(i % side, i / side % side, i / side / side);
            if (float a = alpha(voxels, side, 6, v, wanted.leaf); a > 0.001f) cubes.push_back({v, heat_colour(a)});
        }
        ASSERT_GT(cubes.size(), 10u);
        CubesVerdict verdict = judge_cubes(shown, session->size(), c, grid, side, cubes);
        EXPECT_GT(verdict.hits, 300) << "mip " << wanted.mip;
        EXPECT_LE(verdict.wrong, 4) << "mip " << wanted.mip << ", leaf " << wanted.leaf_name; // rays along an edge
    }
}

TEST_F(DebugViews, SlicesAreTheVoxels) {
    open("lrsm_tuned", {{"gather.max_steps", "1"}, {"view_slice.mip", "1"}, {"view_slice.at", "0.3"}}, {"view_slice"});
    std::vector<float> voxels = texture("voxels.occlusion").read(1);
    for (int axis = 0; axis < 3; ++axis) {
        set("view_slice.axis", std::string(1, "xyz"[axis]));
        render();
        std::vector<float> shown = texture("debug.voxel_slice").read();
        float sum = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                int along = int(0.3f * 16), right = x / 2, up = 15 - y / 2;
                glm::ivec3 v = axis == 0   ? glm::ivec3(along, up, right)
                               : axis == 1 ? glm::ivec3(right, along, y / 2)
                                           : glm::ivec3(right, up, along);
                float told = shown[size_t(32 * y + x)];
                ASSERT_EQ(told, alpha(voxels, 16, 6, v, 0)) << "axis " << axis << " at " << x << ", " << y;
                sum += told;
            }
        }
        EXPECT_GT(sum, 4) << "axis " << axis;
    }
}

TEST_F(DebugViews, MosaicShowsEachLayersTexels) {
    open("lrsm",
         {{"gather.max_steps", "1"},
          {"view_mosaic.tile", "32"},
          {"lrsm_layers.depth_layers", "4"},
          {"lrsm_layers.skip_empty", "1"}},
         {"view_mosaic"});
    int stored = session->graph().buffer("lrsm.summary")->read_all<int>()[0];
    const TextureDesc& desc = texture("lrsm.radiance").desc();
    ASSERT_EQ(desc.size.x, 32);
    ASSERT_GT(stored, 2);
    ASSERT_LT(stored, desc.size.z); // some places of the pool hold nothing
    int width = texture("debug.lrsm").desc().size.x;
    ASSERT_EQ(width, 34 * desc.mips);
    ASSERT_EQ(texture("debug.lrsm").desc().size.y, 34 * desc.size.z);
    for (int quantity = 0; quantity < 5; ++quantity) {
        static const char* const names[] = {"radiance", "normal", "depth", "opacity", "variance"};
        set("view_mosaic.quantity", names[quantity]);
        render();
        std::vector<float> shown = texture("debug.lrsm").read();
        int compared = 0;
        for (int mip = 0; mip < desc.mips; ++mip) {
            std::vector<float> radiance = texture("lrsm.radiance").read(mip), normal = texture("lrsm.normal").read(mip),
                               depth = texture("lrsm.depth").read(mip);
            int side = std::max(32 >> mip, 1);
            for (int i = 0; i < stored * 32 * 32; ++i) {
                int layer = i / 1024, x = i % 32, y = i / 32 % 32;
                size_t from = size_t(x * side / 32 + side * (y * side / 32 + side * layer));
                size_t to = size_t(34 * mip + 1 + x + width * (34 * layer + 1 + y));
                float a = normal[4 * from + 3], b = std::max(depth[4 * from + 2], 1e-6f), mean = depth[4 * from] / b;
                if (a <= 0) continue;
                glm::vec3 wanted = quantity == 0   ? rgb(radiance, from) / a
                                   : quantity == 1 ? 0.5f + 0.5f * rgb(normal, from) / a
                                   : quantity == 2 ? glm::vec3(mean)
                                   : quantity == 3 ? glm::vec3(a)
                                                   : glm::vec3(std::max(depth[4 * from + 1] / b - mean * mean, 0.0f));
                float most = std::max({wanted.x, wanted.y, wanted.z, 0.01f});
                ASSERT_LT(luminance_free_error(rgb(shown, to), wanted), 2e-3f * most)
                    << names[quantity] << ", layer " << layer << ", mip " << mip << " at " << x << ", " << y;
                ++compared;
            }
        }
        EXPECT_GT(compared, 500) << names[quantity];
        // Places without a layer are hatched: grey only.
        glm::vec3 bare = rgb(shown, size_t(20 + width * (34 * stored + 20)));
        EXPECT_TRUE(bare.x == bare.y && bare.x < 0.13f) << bare.x;
    }
    set("lrsm_layers.skip_empty", "0"); // then empty layers are stored, and crossed out
    render();
    std::vector<float> shown = texture("debug.lrsm").read();
    int crossed = 0;
    for (int layer = 0; layer < desc.size.z; ++layer) {
        glm::vec3 middle = rgb(shown, size_t(1 + 16 + width * (34 * layer + 1 + 16)));
        crossed += std::abs(middle.x - 0.8f) < 1e-3f && middle.y < 0.06f;
    }
    EXPECT_EQ(crossed, desc.size.z - stored);
}

TEST_F(DebugViews, RecordedConesAreThoseOfTheGather) {
    for (const char* graph : {"lrsm", "lrsm_tuned"}) {
        open(graph, {}, {"inspect"});
        set("gather.hit_lookup", "layers"); // the walk has no spheres of layers to record
        int surfaces = 0, lit = 0;
        for (glm::vec2 place : {glm::vec2(0.5f), {0.2f, 0.6f}, {0.45f, 0.8f}, {0.7f, 0.6f}, {0.02f, 0.02f}}) {
            for (const char* step : {"0.5", "1.5"}) {
                set("gather.cone_step", step); // the inspector's, too
                set("inspect.pixel", fmt::format("{},{}", place.x, place.y));
                render();
                ASSERT_TRUE(session->graph().buffer("debug.cones"));
                std::vector<std::byte> bytes = session->graph().buffer("debug.cones")->read_all<std::byte>();
                ConeRecords records;
                std::memcpy(&records, bytes.data(), sizeof records);
                std::vector<RecordedSphere> spheres((bytes.size() - sizeof records) / sizeof(RecordedSphere));
                ASSERT_EQ(spheres.size(), size_t(k_max_recorded_cones) * k_max_recorded_spheres);
                std::memcpy(spheres.data(), bytes.data() + sizeof records, spheres.size() * sizeof(RecordedSphere));

                const InspectedPixel& at = records.inspected;
                const GpuTexture& gathered = texture("lrsm.irradiance");
                glm::ivec2 size(gathered.desc().size);
                EXPECT_EQ(at.texel, glm::ivec2(place * glm::vec2(size)));
                std::vector<float> texels = gathered.read();
                for (int k = 0; k < 4; ++k) {
                    float stored = texels[size_t(4 * (at.texel.x + size.x * at.texel.y) + k)];
                    EXPECT_EQ(at.gathered[k], stored);
                    EXPECT_NEAR(at.summed[k], stored, 1e-3f * std::abs(stored) + 1e-6f) << graph << " channel " << k;
                }
                std::vector<float> depths = texture("gbuffer.depth").read();
                bool surface = depths[size_t(at.pixel.x + session->size().x * at.pixel.y)] > 0;
                ASSERT_EQ(at.cones, !surface ? 0 : graph == std::string("lrsm") ? 6 : 24);
                surfaces += surface;
                lit += at.summed.x > 0;

                glm::vec4 sum(0);
                float weights = 0;
                for (int i = 0; i < at.cones; ++i) {
                    const RecordedCone& cone = records.cones[i];
                    sum += cone.weight * glm::vec4(cone.radiance, cone.occlusion);
                    weights += cone.weight;
                    EXPECT_NEAR(glm::length(cone.direction), 1, 1e-4f);
                    ASSERT_EQ(cone.kept, std::min(cone.spheres, k_max_recorded_spheres));
                    if (cone.kept < cone.spheres) continue;
                    glm::vec3 light(0);
                    float taken = 0, before = -1;
                    for (int k = 0; k < cone.kept; ++k) {
                        const RecordedSphere& sphere = spheres[size_t(cone.first + k)];
                        light += sphere.radiance;
                        if (!sphere.at_hit) taken += sphere.share;
                        EXPECT_GE(sphere.t, sphere.at_hit ? 0 : before);
                        EXPECT_LT(glm::distance(sphere.centre, at.apex + sphere.t * cone.direction), 1e-4f);
                        EXPECT_TRUE(sphere.layers > 0 || sphere.radiance == glm::vec3(0));
                        EXPECT_EQ(sphere.layers > 0, sphere.map_level >= 0);
                        before = sphere.t;
                    }
                    for (int k = 0; k < 3; ++k)
                        EXPECT_NEAR(light[k], cone.radiance[k], 1e-4f * cone.radiance[k] + 1e-6f);
                    if (graph == std::string("lrsm")) {
                        EXPECT_NEAR(taken, cone.occlusion, 1e-4f);
                    }
                }
                EXPECT_NEAR(weights, surface ? 1 : 0, 1e-4f);
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(sum[k], at.summed[k], 1e-4f * at.summed[k] + 1e-6f);
            }
        }
        EXPECT_GE(surfaces, 4) << graph;
        EXPECT_LT(surfaces, 10) << graph; // one is background
        EXPECT_GE(lit, 3) << graph;
    }
}

TEST_F(DebugViews, ConesAreDrawnOverThePicture) {
    open("lrsm", {{"inspect.pixel", "0.5,0.7"}, {"view_cones.show", "axes"}}, {"view_cones"});
    auto decoded = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    auto untouched = [&] {
        std::vector<float> shown = texture("debug.cones_view").read(), display = texture("out.display").read();
        int same = 0;
        for (size_t i = 0; i < shown.size() / 4; ++i) {
            glm::vec3 behind(decoded(display[4 * i]), decoded(display[4 * i + 1]), decoded(display[4 * i + 2]));
            same += luminance_free_error(rgb(shown, i), 0.5f * behind) < 1e-3f;
        }
        return same;
    };
    int all = session->size().x * session->size().y, with_axes = untouched();
    EXPECT_GT(with_axes, all / 2);
    EXPECT_LT(with_axes, all - 60);
    // The cross beside the pixel.
    glm::ivec2 pixel(int(0.5f * 48), int(0.7f * 40));
    std::vector<float> shown = texture("debug.cones_view").read();
    glm::vec3 cross = rgb(shown, size_t(pixel.x + 6 + 48 * pixel.y));
    EXPECT_LT(luminance_free_error(cross, {1, 1, 0.2f}), 1e-2f);
    set("view_cones.show", "all");
    render();
    EXPECT_LT(untouched(), with_axes - 50);
    set("view_cones.only_cone", "0");
    render();
    EXPECT_GT(untouched(), all / 3);
}
