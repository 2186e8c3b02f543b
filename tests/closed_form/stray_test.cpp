// One vertex or triangle far away changes nothing in grids and maps but what it itself puts there.

#include "support/made_scenes.h"

using namespace bounce;

namespace {

using Sets = std::vector<std::pair<std::string, std::string>>;

class Strays : public SceneGraphTest {
  protected:
    std::vector<float> run(const Scene& scene, const std::string& graph, const std::string& resource,
                           const Sets& sets) {
        SceneRunner runner(scene, {directional_light({-0.3f, -1, -0.2f}, glm::vec3(1))},
                           root / ("assets/graphs/" + graph + ".json"), sets, {16, 16});
        runner.camera.position = {1, 3, 4};
        runner.camera.target = glm::vec3(0);
        runner.frame();
        return runner.read(resource);
    }
    std::vector<float> voxels(const Scene& scene, const Sets& sets) {
        SceneRunner runner(scene, {}, graph_file(R"("passes":[{"type":"occlusion_voxels"}])"), sets);
        runner.frame();
        return runner.read("voxels.occlusion");
    }
};

/// Beside the blocks, beside them and too large for floats, above them; and, last, through them and too large for
/// floats.
std::vector<Scene> with_strays() {
    std::vector<Scene> scenes;
    const glm::vec3 strays[][3] = {{{50, 0, 0}, {50.1f, 0, 0}, {50, 1e7f, 0}},
                                   {{50, 0.3f, 0}, {50.1f, 0.3f, 0}, {50, 1e19f, 0}},
                                   {{-1e7f, 900, 1e7f}, {1e7f, 900, 1e7f}, {0, 900, -1e7f}},
                                   {{0, 0.3f, 0}, {0.1f, 0.3f, 0}, {0, 1e19f, 0}}};
    for (const auto& stray : strays) {
        MadeScene made;
        made.scene = blocks();
        scenes.push_back(made.triangle(stray[0], stray[1], stray[2]).scene);
    }
    return scenes;
}

} // namespace

TEST_F(Strays, GridsAndMapsStayAsTheyAre) {
    struct Kind {
        const char *graph, *resource;
        Sets sets;
    };
    const Sets small_maps{{"ldm.maps", "16"}, {"ldm.resolution", "32"}, {"shadow_maps.resolution", "64"}};
    Sets by_compute = small_maps;
    by_compute.emplace_back("ldm.route", "compute");
    const std::vector<Kind> kinds = {
        {"ldm_ao", "out.ambient_occlusion", small_maps},
        {"ldm_ao", "out.ambient_occlusion_dmax", by_compute},
    };
    const Sets routes[] = {{{"occlusion_voxels.resolution", "32"}},
                           {{"occlusion_voxels.resolution", "32"}, {"occlusion_voxels.fill", "exact"}},
                           {{"occlusion_voxels.resolution", "32"}, {"occlusion_voxels.route", "compute"}}};
    std::vector<Scene> strays = with_strays();
    for (const Kind& kind : kinds) {
        std::vector<float> without = run(blocks(), kind.graph, kind.resource, kind.sets);
        for (size_t i = 0; i + 1 < strays.size(); ++i)
            EXPECT_EQ(run(strays[i], kind.graph, kind.resource, kind.sets), without) << kind.graph << " " << i;
    }
    for (const Sets& route : routes) {
        std::vector<float> without = voxels(blocks(), route);
        for (size_t i = 0; i < strays.size(); ++i)
            EXPECT_EQ(voxels(strays[i], route), without) << route.back().second << " " << i;
    }
}

TEST_F(Strays, AHugeFloorIsInTheGridAsFarAsTheGridGoes) {
    constexpr int k_side = 32;
    MadeScene made;
    made.box({-1, 0, -1}, {1, 1, 1}).triangle({-1e5f, 0.53f, 1e5f}, {1e5f, 0.53f, 1e5f}, {0, 0.53f, -1e5f});
    EXPECT_EQ(scene_facts(made.scene).bounds.max, glm::vec3(1));
    // The cube's side is 2 · (1 + 2/32), and the floor lies in layer 16.
    for (const char* route : {"compute", "raster"}) {
        Sets sets{{"occlusion_voxels.resolution", std::to_string(k_side)}, {"occlusion_voxels.route", route}};
        if (std::string(route) == "raster") sets.emplace_back("occlusion_voxels.fill", "exact");
        std::vector<float> got = voxels(made.scene, sets);
        int full = 0;
        for (int z = 0; z < k_side; ++z)
            for (int x = 0; x < k_side; ++x)
                full += got[size_t((z * k_side + 16) * k_side + x)] > 0;
        EXPECT_EQ(full, k_side * k_side) << route;
        EXPECT_EQ(got[size_t((5 * k_side + 20) * k_side + 8)], 0) << route; // inside the box there is nothing else
    }
}

TEST_F(Strays, WhatLiesOutsideOfTheMapsIsOpen) {
    MadeScene made;
    made.box({-1, 0, -1}, {1, 1, 1}).triangle({-1e5f, -0.01f, 1e5f}, {1e5f, -0.01f, 1e5f}, {0, -0.01f, -1e5f});
    for (const char* route : {"raster", "compute"}) {
        SceneRunner runner(made.scene, {}, root / "assets/graphs/ldm_ao.json",
                           {{"ldm.maps", "16"}, {"ldm.resolution", "32"}, {"ldm.route", route}}, {8, 8});
        runner.camera.position = {40, 5, 40};
        runner.camera.target = {40, 0, 39};
        runner.frame();
        for (float open : runner.read("out.ambient_occlusion"))
            EXPECT_NEAR(open, 1, 0.1) << route; // 16 axes sum to 1 within that
    }
}
