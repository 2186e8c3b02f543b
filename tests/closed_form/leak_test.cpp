// Light that leaks into a sealed room: a box with walls of .25 … 4 voxels, lit from outside; and through a curtain.
// Inside it is dark. What the method sees there is told as a share of what it sees when the lit wall is taken away, so
// that a method that loses light everywhere does not look tight.
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

using namespace bounce;

namespace {

constexpr int k_resolution = 64;

class Leak : public GpuTest {
  protected:
    /// A room of 2 × 2 × 2 m whose walls are `thickness` metres; `open`: without the wall at +x.
    std::string room(const std::string& name, float thickness, bool open) {
        TinyScene scene;
        float i = 1, o = 1 + thickness;
        glm::vec3 grey(0.7f);
        // Inner faces look inward.
        scene.quad({-i, -i, i}, {i, -i, i}, {i, -i, -i}, {-i, -i, -i}, grey);
        scene.quad({-i, i, -i}, {i, i, -i}, {i, i, i}, {-i, i, i}, grey);
        scene.quad({-i, -i, -i}, {i, -i, -i}, {i, i, -i}, {-i, i, -i}, grey);
        scene.quad({i, -i, i}, {-i, -i, i}, {-i, i, i}, {i, i, i}, grey);
        scene.quad({-i, -i, i}, {-i, -i, -i}, {-i, i, -i}, {-i, i, i}, grey);
        if (!open) {
            scene.quad({i, -i, -i}, {i, -i, i}, {i, i, i}, {i, i, -i}, grey);
            scene.box({-o, -o, -o}, {o, o, o}, grey);
        }
        // Something outside for the light to fall on, and bounds that are the same for every thickness.
        scene.quad({3, -2, 2}, {3, -2, -2}, {3, 2, -2}, {3, 2, 2}, grey);
        scene.quad({-1.5f, -2, 2}, {3, -2, 2}, {3, -2, -2}, {-1.5f, -2, -2}, grey);
        scene.write(folder.path(), name);
        return write_shot(
            folder.path(), name, name + ".gltf", {-0.6f, 0, 0.8f}, {0.9f, -0.3f, -0.6f},
            R"({"type":"spot","position":[2.8,1.4,0],"direction":[-1,-0.75,0],"intensity":60,"outer_cone_deg":50})");
    }
    /// The mean of out.indirect_diffuse, as seen from inside.
    double seen(const std::string& shot, const std::string& graph,
                std::vector<std::pair<std::string, std::string>> sets) {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = glm::ivec2(32);
        options.sets = std::move(sets);
        if (graph.starts_with("lrsm")) {
            options.sets.emplace_back("occlusion_voxels.resolution", std::to_string(k_resolution));
            options.sets.emplace_back("rsm.resolution", "256");
        } else {
            options.sets.emplace_back("voxelization.resolution", std::to_string(k_resolution));
        }
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
        std::vector<float> values = session.graph().texture("out.indirect_diffuse")->read();
        double sum = 0;
        for (size_t i = 0; i < values.size(); i += 4)
            sum += values[i] + values[i + 1] + values[i + 2];
        return sum;
    }
    /// Two rooms of 2 × 2 × 2 m beside each other; a lamp in the right one, the camera in the left one. Between them is
    /// nothing, or at x = `at` a curtain of two sheets `gap` metres apart that face away from each other.
    std::string two_rooms(const std::string& name, float at, float gap, bool curtain) {
        TinyScene scene;
        glm::vec3 grey(0.7f);
        scene.quad({-2, -1, 1}, {2, -1, 1}, {2, -1, -1}, {-2, -1, -1}, grey);
        scene.quad({-2, 1, -1}, {2, 1, -1}, {2, 1, 1}, {-2, 1, 1}, grey);
        scene.quad({-2, -1, -1}, {2, -1, -1}, {2, 1, -1}, {-2, 1, -1}, grey);
        scene.quad({2, -1, 1}, {-2, -1, 1}, {-2, 1, 1}, {2, 1, 1}, grey);
        scene.quad({-2, -1, 1}, {-2, -1, -1}, {-2, 1, -1}, {-2, 1, 1}, grey);
        scene.quad({2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}, grey);
        if (curtain) {
            float l = at - 0.5f * gap, h = at + 0.5f * gap;
            scene.quad({h, -1, 1}, {h, -1, -1}, {h, 1, -1}, {h, 1, 1}, grey);
            scene.quad({l, -1, -1}, {l, -1, 1}, {l, 1, 1}, {l, 1, -1}, grey);
        }
        scene.write(folder.path(), name);
        return write_shot(
            folder.path(), name, name + ".gltf", {-0.2f, 0, 0.3f}, {-2, -0.2f, -0.1f},
            R"({"type":"spot","position":[0.3,0.2,0],"direction":[1,-0.1,0],"intensity":10,"outer_cone_deg":60})");
    }
    TempFolder folder;
};

} // namespace

TEST_F(Leak, OfASealedRoomAgainstTheThicknessOfItsWalls) {
    const float voxel = 4.5f * (1 + 2.0f / k_resolution) / k_resolution; // the floor's length is the longest edge
    struct Variant {
        const char* name;
        const char* graph;
        std::vector<std::pair<std::string, std::string>> sets;
        double most;            ///< leak that is let pass from one voxel of wall on: twice what was measured
        double most_thin = 1e9; ///< through a quarter of a voxel
    };
    // As published more light leaks in than an open wall gives (4.0 at one voxel): it is told, and no limit holds.
    const Variant variants[] = {
        {"lrsm (published)", "lrsm", {}, 1e9},
        {"lrsm_tuned", "lrsm_tuned", {}, 0.03},
        // By voxels alone: a sphere around a triangle behind a thin wall holds the wall's other side.
        {"lrsm_tuned, layers", "lrsm_tuned", {{"gather.hit", "plane"}, {"gather.hit_lookup", "layers"}}, 0.03},
        {"lrsm_tuned, layers, thin cones",
         "lrsm_tuned",
         {{"gather.hit", "plane"},
          {"gather.hit_lookup", "layers"},
          {"gather.exact_hits", "false"},
          {"gather.start_offset", "1"}},
         0.03},
        {"lrsm_tuned, walk",
         "lrsm_tuned",
         {{"gather.hit", "plane"}, {"gather.hit_lookup", "map"}, {"gather.normal_offset", "0.5"}},
         0.006,
         0.012},
        {"lrsm_tuned, isotropic",
         "lrsm_tuned",
         {{"gather.hit", "plane"},
          {"gather.hit_lookup", "layers"},
          {"occlusion_voxels.directional_leaves", "false"},
          {"voxel_mips.mip_rule", "mean"}},
         0.05},
        {"dvs (published)", "dvs", {}, 1e9},
        {"dvs, isotropic", "dvs", {{"filter.mip_rule", "mean"}, {"filter_bounced.mip_rule", "mean"}}, 1e9},
        // Mean planes of voxels that a corner shares let .0074 through a quarter of a voxel.
        {"dvs_tuned", "dvs_tuned", {}, 0.001, 0.015},
        {"dvs_tuned, voxels alone",
         "dvs_tuned",
         {{"gather.hit", "plane"}, {"gather.hit_lookup", "voxels"}},
         0.001,
         0.015},
        {"dvs_tuned, no planes",
         "dvs_tuned",
         {{"gather.hit", "plane"}, {"voxelization.planes", "false"}},
         0.001,
         0.002},
    };
    std::map<std::string, std::vector<double>> leaks;
    for (const Variant& variant : variants) {
        double open = seen(room("open", voxel, true), variant.graph, variant.sets);
        ASSERT_GT(open, 0) << variant.name;
        std::string line;
        for (float thickness : {0.25f, 1.0f, 2.0f, 4.0f}) {
            double leak = seen(room("closed", thickness * voxel, false), variant.graph, variant.sets) / open;
            line += fmt::format("  {} voxels {:.4f}", thickness, leak);
            RecordProperty(fmt::format("{}_{}", variant.name, thickness), fmt::format("{:.6f}", leak));
            leaks[variant.name].push_back(leak);
            EXPECT_LE(leak, thickness < 1 ? variant.most_thin : variant.most)
                << variant.name << ", " << thickness << " voxels";
        }
        fmt::print("    leak of {:<22}{}\n", variant.name, line);
    }
    // Six directions hold a little better than means that know none.
    for (size_t i = 0; i < 4; ++i)
        EXPECT_LT(leaks["dvs (published)"][i], leaks["dvs, isotropic"][i]);
}

/// A curtain of two sheets in the same voxels, whose averaged normals cancel, hangs between a lit wall and the
/// receiver.
TEST_F(Leak, ThroughACurtainWhoseNormalsCancel) {
    const float voxel = 4 * (1 + 2.0f / k_resolution) / k_resolution;
    struct Variant {
        const char* name;
        const char* graph;
        std::vector<std::pair<std::string, std::string>> sets;
    };
    const Variant variants[] = {
        {"dvs, Eq. 2", "dvs", {}},
        {"dvs, Eq. 3-5", "dvs", {{"voxel_direct.attenuation", "normal_weighted"}}},
        {"dvs, isotropic", "dvs", {{"filter.mip_rule", "mean"}, {"filter_bounced.mip_rule", "mean"}}},
        {"dvs_tuned", "dvs_tuned", {}},
    };
    std::map<std::string, double> leaks;
    for (const Variant& variant : variants) {
        double open = seen(two_rooms("open", 0, 0, false), variant.graph, variant.sets);
        ASSERT_GT(open, 0) << variant.name;
        double leak = seen(two_rooms("hung", 0.5f * voxel, 0.2f * voxel, true), variant.graph, variant.sets) / open;
        RecordProperty(fmt::format("curtain_{}", variant.name), fmt::format("{:.6f}", leak));
        fmt::print("    leak of {:<16} through a curtain {:.4f}\n", variant.name, leak);
        leaks[variant.name] = leak;
    }
    // Measured: .163, .163, .995, .0188. Of the last, 128 cones a texel tell .0185: fewer that repeat in blocks of 4 ×
    // 4 told less (.012).
    EXPECT_LT(leaks["dvs, Eq. 2"], 0.33);
    EXPECT_GT(leaks["dvs, isotropic"], 3 * leaks["dvs, Eq. 2"]);
    EXPECT_LT(leaks["dvs_tuned"], 0.02);
}
