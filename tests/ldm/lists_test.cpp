// The lists of layered depth maps against a rasterizer in double; the same lists whatever room, order or number of
// batches they were built with.
#include "ldm/lists_fixture.h"

#include "scene/find_scene.h"
#include "support/shared_scene.h"

#include <gmock/gmock.h>

using namespace bounce;

namespace {

Scene cornell() {
    return load_gltf(find_scene("cornell.gltf", "."));
}
/// Triangles of all sizes: a fan of slivers, a fine grid on a wave, quads through each other, two in one place.
Scene slivers() {
    MadeScene made;
    for (int i = 0; i < 40; ++i) {
        float a = 6.2832f * float(i) / 40, b = 6.2832f * float(i + 1) / 40;
        made.triangle({0.03f, 0.02f, 0.01f}, {std::cos(a), std::sin(a), 0.3f * std::sin(5 * a)},
                      {std::cos(b), std::sin(b), 0.3f * std::sin(5 * b)});
    }
    auto wave = [](int i, int k) {
        float x = -0.9f + 1.7f * float(i) / 30, y = -0.8f + 1.9f * float(k) / 30;
        return glm::vec3(x, y, -0.5f + 0.2f * std::sin(4 * x) * std::cos(3 * y));
    };
    for (int i = 0; i < 30; ++i)
        for (int k = 0; k < 30; ++k)
            made.quad(wave(i, k), wave(i + 1, k), wave(i + 1, k + 1), wave(i, k + 1));
    for (int i = 0; i < 2; ++i)
        made.quad({-0.9f, -0.7f, 0.9f}, {0.8f, -0.6f, -0.9f}, {0.9f, 0.8f, -0.8f}, {-0.8f, 0.7f, 0.95f});
    made.quad({-1, 0.1f, -1}, {1, 0.13f, -1}, {1, 0.17f, 1}, {-1, 0.14f, 1});
    return made.scene;
}

struct Case {
    const char* name;
    Scene (*scene)();
    int maps, resolution;
};
struct Route {
    const char* name;
    Sets sets;
};
const Route k_routes[] = {{"raster", {}},
                          {"compute", {{"ldm.route", "compute"}}},
                          {"arrays", {{"ldm.route", "compute"}, {"ldm.storage", "arrays"}}}};

class LayeredDepthMaps : public LdmTest {
  protected:
    void expect_exact(const std::string& what, const LdmComparison& count) {
        std::string told = fmt::format("{} fragments in {} texels, up to {} in one; {:.2f} % of texels left out",
                                       count.fragments, count.texels, count.longest, 100 * count.excluded_share());
        fmt::print("    {:<34} {}\n", what, told);
        RecordProperty("excluded_" + what, fmt::format("{:.4f}", count.excluded_share()));
        EXPECT_EQ(count.wrong, 0) << what << ": " << count.first_wrong;
        EXPECT_EQ(count.wrong_slopes, 0) << what << ", of " << count.slopes;
        EXPECT_GT(count.fragments, size_t(count.texels) / 8) << what;
    }
    void expect_large_scene_exact(const char* file, const std::string& name) {
        std::filesystem::path path = shared_scene(file);
        if (path.empty()) GTEST_SKIP() << "the test scene is not beside the source tree";
        Scene scene = load_gltf(path);
        for (Material& material : scene.materials) // by the triangles alone
            material.alpha_mode = AlphaMode::opaque;
        for (const Route& route : k_routes) {
            if (route.name == std::string("arrays")) continue; // of the same lists
            Sets sets = route.sets;
            sets.insert(sets.end(), {{"ldm.maps", "2"}, {"ldm.resolution", "64"}, {"ldm.tilted", "true"}});
            SceneRunner run(scene, {}, graph_file(k_maps_alone), sets);
            whole_frame(run);
            expect_exact(std::string(route.name) + "_" + name, compare_lists(run));
        }
    }
};
class ListsOf : public LayeredDepthMaps, public testing::WithParamInterface<Case> {};

} // namespace

TEST_P(ListsOf, AScene) {
    Scene scene = GetParam().scene();
    for (const Route& route : k_routes) {
        for (const char* nodes : {"depth", "plane"}) {
            Sets sets = route.sets;
            sets.insert(sets.end(), {{"ldm.maps", std::to_string(GetParam().maps)},
                                     {"ldm.resolution", std::to_string(GetParam().resolution)},
                                     {"ldm.nodes", nodes},
                                     {"ldm.tilted", "true"}});
            SceneRunner run(scene, {}, graph_file(k_maps_alone), sets);
            whole_frame(run);
            LdmComparison count = compare_lists(run);
            expect_exact(std::string(route.name) + "_" + nodes, count);
            if (std::string(nodes) == "plane") {
                EXPECT_GT(count.slopes, 1000);
            }
            EXPECT_LT(count.excluded_share(), 0.6);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ListsOf,
                         testing::Values(Case{"blocks", blocks, 20, 32}, Case{"slivers", slivers, 9, 48},
                                         Case{"cornell", cornell, 16, 25}, Case{"cornell_fine", cornell, 3, 150}),
                         [](auto& test) { return std::string(test.param.name); });

/// Untilted, walls stand on edge to some maps and lie along the texels of others.
TEST_F(LayeredDepthMaps, OfAxesAlongTheWalls) {
    for (const Route& route : k_routes) {
        Sets sets = route.sets;
        sets.insert(sets.end(), {{"ldm.maps", "15"}, {"ldm.resolution", "31"}});
        SceneRunner run(blocks(), {}, graph_file(k_maps_alone), sets);
        whole_frame(run);
        expect_exact(std::string(route.name) + "_untilted", compare_lists(run));
    }
}

TEST_F(LayeredDepthMaps, OfSibenik) {
    expect_large_scene_exact("sibenik/Sibenik.gltf", "sibenik");
}
TEST_F(LayeredDepthMaps, OfSponza) {
    expect_large_scene_exact("sponza/Sponza.gltf", "sponza");
}

TEST_F(LayeredDepthMaps, LeaveOutWhatAlphaRejects) {
    for (bool by_texture : {false, true}) {
        AlphaTest alpha;
        // A texel of the map averages some of the texture's: near the border between both halves they mix.
        alpha.border = by_texture ? 0.1 : 2e-3;
        alpha.margin = [&](glm::dvec2 uv, double a) { return (by_texture ? uv.x : a) - 0.5; };
        for (const Route& route : k_routes) {
            Sets sets = route.sets;
            sets.insert(sets.end(), {{"ldm.maps", "8"}, {"ldm.resolution", "40"}, {"ldm.tilted", "true"}});
            SceneRunner run(half_transparent(by_texture), {}, graph_file(k_maps_alone), sets);
            whole_frame(run);
            expect_exact(fmt::format("{}_alpha_{}", route.name, by_texture ? "texture" : "colour"),
                         compare_lists(run, alpha));
        }
    }
}

TEST_F(LayeredDepthMaps, FollowWhatMoves) {
    for (const Route& route : k_routes) {
        Sets sets = route.sets;
        sets.insert(sets.end(), {{"ldm.maps", "8"}, {"ldm.resolution", "32"}, {"ldm.tilted", "true"}});
        SceneRunner run(blocks(), {}, graph_file(k_maps_alone), sets);
        whole_frame(run);
        std::vector<uint32_t> before = LdmLists(run).canonical();
        Instance& board = run.state.instances.back();
        board.dynamic = true;
        board.world = glm::mat4(glm::vec4(0.8f, 0, 0.3f, 0), glm::vec4(0, 0.7f, 0, 0), glm::vec4(-0.3f, 0, 0.8f, 0),
                                glm::vec4(0.4f, 0.1f, -0.2f, 1));
        whole_frame(run);
        EXPECT_NE(LdmLists(run).canonical(), before);
        expect_exact(std::string(route.name) + "_moved", compare_lists(run));
    }
}

/// A sheet cut into triangles whose corners lie on texels' centres, and whose edges go through many: each centre
/// belongs to one triangle alone, on edges and corners too.
TEST_F(LayeredDepthMaps, CoverEachCentreOfASheetOnce) {
    constexpr int k_side = 80;
    // As ldm_view fits a map to the box from −1 to 1.
    constexpr double k_texel = 2 * (1 + 0.02 / k_side) / k_side;
    for (int spacing : {4, 20}) {
        MadeScene made;
        uint32_t random = 7;
        std::vector<std::vector<glm::vec3>> grid;
        for (int i = 0; i * spacing < k_side; ++i) {
            grid.emplace_back();
            for (int k = 0; k * spacing < k_side; ++k) {
                auto place = [&](int cell) {
                    random = random * 1664525u + 1013904223u;
                    int texel = cell * spacing + (spacing == 4 ? int(random >> 16) % 3 - 1 : 0);
                    if (cell == 0) return -1.0;
                    if ((cell + 1) * spacing >= k_side) return 1.0;
                    return (texel + 0.5 - k_side / 2) * k_texel;
                };
                double x = place(i), y = place(k);
                grid.back().emplace_back(float(x), float(y), 0.0f);
            }
        }
        for (size_t i = 0; i + 1 < grid.size(); ++i) {
            for (size_t k = 0; k + 1 < grid[i].size(); ++k) {
                glm::vec3 a = grid[i][k], b = grid[i + 1][k], c = grid[i + 1][k + 1], d = grid[i][k + 1];
                // Both ways of winding and of cutting.
                if ((i + k) % 2)
                    made.triangle(a, b, c).triangle(a, d, c);
                else
                    made.triangle(b, a, d).triangle(b, c, d);
            }
        }
        made.triangle({-1, -1, 1}, {-0.999f, -1, 1}, {-1, -0.999f, 1}); // some depth
        for (const Route& route : k_routes) {
            Sets sets = route.sets;
            sets.insert(sets.end(), {{"ldm.maps", "1"}, {"ldm.resolution", std::to_string(k_side)}});
            SceneRunner run(made.scene, {}, graph_file(k_maps_alone), sets);
            whole_frame(run);
            LdmLists lists(run);
            EXPECT_NEAR(lists.views[0].texel.x, k_texel, 1e-6);
            int wrong = 0, on_edges = 0;
            LdmOracle oracle(run.scene, run.state, lists.views[0], k_side);
            for (int y = 1; y < k_side - 1; ++y) {
                for (int x = 1; x < k_side - 1; ++x) {
                    wrong += lists.list(0, x, y).size() != 1;
                    on_edges += oracle.at(x, y).excluded;
                }
            }
            EXPECT_EQ(wrong, 0) << route.name << ", " << spacing;
            EXPECT_GT(on_edges, spacing == 4 ? 700 : 200) << "else nothing was tested";
        }
    }
}

/// Whatever order the fragments come in.
TEST_F(LayeredDepthMaps, AreTheSameInEachOfAHundredBuilds) {
    for (const Route& route : k_routes) {
        for (const char* nodes : {"depth", "surface"}) {
            if (route.name == std::string("arrays") || (route.name == std::string("compute") && nodes[0] == 'd'))
                continue; // the rest is slower, and goes through the same code
            Sets sets = route.sets;
            sets.insert(sets.end(), {{"ldm.maps", "6"}, {"ldm.resolution", "32"}, {"ldm.nodes", nodes}});
            SceneRunner run(slivers(), {}, graph_file(k_maps_alone), sets);
            whole_frame(run);
            std::vector<uint32_t> first = LdmLists(run).canonical();
            EXPECT_GT(first.size(), 6u * 32 * 32 * 3);
            for (int i = 1; i < 100; ++i) {
                run.frame();
                ASSERT_EQ(LdmLists(run).canonical(), first) << route.name << ", " << nodes << ", build " << i;
            }
        }
    }
}

/// What finds no room is counted; the pool grows to what was asked for, and holds the same as ample room does.
TEST_F(LayeredDepthMaps, GrowUntilNothingIsLost) {
    for (const Route& route : k_routes) {
        Sets sets = route.sets;
        sets.insert(sets.end(), {{"ldm.maps", "8"}, {"ldm.resolution", "32"}});
        Sets ample = sets, scarce = sets;
        ample.emplace_back("ldm.fragments", "100");
        scarce.emplace_back("ldm.fragments", "0.1");
        SceneRunner much(blocks(), {}, graph_file(k_maps_alone), ample),
            little(blocks(), {}, graph_file(k_maps_alone), scarce);
        much.frame();
        EXPECT_FALSE(much.graph.needs_larger_buffers());
        EXPECT_EQ(counter(much, "dropped fragments"), 0);

        little.frame();
        EXPECT_TRUE(little.graph.needs_larger_buffers());
        int64_t lost = counter(little, "dropped fragments");
        int64_t wanted = counter(little, "fragments of all maps");
        EXPECT_GT(lost, 1000);
        EXPECT_EQ(wanted, counter(much, "fragments of all maps")) << "also those without room are counted";
        EXPECT_EQ(wanted - lost, LdmLists(little).info.capacity);
        // What has found room is in order, and is part of the whole.
        EXPECT_LT(LdmLists(little).canonical().size(), LdmLists(much).canonical().size());

        whole_frame(little);
        EXPECT_EQ(counter(little, "dropped fragments"), 0);
        EXPECT_EQ(LdmLists(little).canonical(), LdmLists(much).canonical());
        EXPECT_GE(LdmLists(little).info.capacity, wanted);
        EXPECT_LT(LdmLists(little).info.capacity, 1.2 * double(wanted)) << "no more than is needed";
    }
}

/// A memory limit only cuts the work into batches.
TEST_F(LayeredDepthMaps, InBatchesGiveTheSameOcclusion) {
    for (const Route& route : k_routes) {
        Sets one = route.sets;
        one.insert(one.end(), {{"ldm.maps", "50"}, {"ldm.resolution", "64"}, {"ldm.tilted", "true"}});
        Sets many = one, grown = one;
        many.emplace_back("ldm.memory", "1");
        grown.insert(grown.end(), {{"ldm.memory", "1"}, {"ldm.fragments", "0.1"}});
        glm::ivec2 size(48, 40);
        SceneRunner whole(blocks(), {}, graph_file(k_occlusion), one, size),
            parts(blocks(), {}, graph_file(k_occlusion), many, size),
            from_little(blocks(), {}, graph_file(k_occlusion), grown, size);
        for (SceneRunner* run : {&whole, &parts, &from_little}) {
            run->camera = towards_blocks();
            whole_frame(*run);
            EXPECT_EQ(counter(*run, "dropped fragments"), 0);
        }
        EXPECT_EQ(LdmLists(whole).info.batches, 1);
        int batches = LdmLists(parts).info.batches;
        EXPECT_GE(batches, 4);
        EXPECT_LE(parts.graph.buffer("ldm.lists")->bytes(), 1024u * 1024u);
        EXPECT_GT(from_little.graph.counters().size(), 2u);
        // As many fragments in all, whichever way they are divided.
        EXPECT_EQ(counter(parts, "fragments of all maps"), counter(whole, "fragments of all maps"));
        EXPECT_EQ(counter(from_little, "fragments of all maps"), counter(whole, "fragments of all maps"));
        for (const char* part : {"out.ambient_occlusion", "out.ambient_occlusion_dmax"}) {
            std::vector<float> a = whole.read(part), b = parts.read(part), c = from_little.read(part);
            double mean = 0;
            for (size_t i = 0; i < a.size(); ++i) {
                // 50 terms are added in another order: their roundings.
                ASSERT_NEAR(a[i], b[i], 4e-6f) << part << ", pixel " << i;
                ASSERT_NEAR(a[i], c[i], 4e-6f) << part << ", pixel " << i;
                mean += a[i] / double(a.size());
            }
            EXPECT_GT(mean, 0.5) << part;
            EXPECT_LT(mean, 0.97) << part;
        }
    }
}

/// Nodes that hold the surface: the colour that scatters, from both routes.
TEST_F(LayeredDepthMaps, HoldTheAlbedoOfTheirSurface) {
    Scene scene = blocks();
    for (Material& material : scene.materials)
        if (material.base_colour.x == 0.2f) material.metallic = 0.75f; // the slab
    for (const Route& route : k_routes) {
        Sets sets = route.sets;
        sets.insert(sets.end(),
                    {{"ldm.maps", "6"}, {"ldm.resolution", "32"}, {"ldm.tilted", "true"}, {"ldm.nodes", "surface"}});
        SceneRunner run(scene, {}, graph_file(k_maps_alone), sets);
        whole_frame(run);
        LdmLists lists(run);
        int n = lists.info.resolution, compared = 0, wrong = 0;
        for (int map = 0; map < lists.info.maps; ++map) {
            // The floor is the only thing below y = 0.
            const LdmView& view = lists.views[size_t(map)];
            for (int i = 0; i < n * n; ++i) {
                for (const LdmFragment& f : lists.list(map, i % n, i / n)) {
                    // Where it is: the maps' axes are at right angles.
                    glm::dvec3 right(view.to_x), up(view.to_y), along(view.to_z);
                    glm::dvec3 x = right / glm::dot(right, right) * (i % n + 0.5 - view.to_x.w) +
                                   up / glm::dot(up, up) * (i / n + 0.5 - view.to_y.w) +
                                   along / glm::dot(along, along) * (double(f.depth) - view.to_z.w);
                    bool floor = std::abs(x.y) < 1e-3 && x.z > 1.45, slab = x.y > 0.69 && x.z < 0.4 && x.x > -0.95;
                    if (!floor && !slab) continue;
                    glm::vec3 colour = floor ? glm::vec3(0.8f, 0.4f, 0.2f) : 0.25f * glm::vec3(0.2f, 0.6f, 0.4f);
                    ++compared;
                    for (int channel = 0; channel < 3; ++channel)
                        wrong += std::abs(float(f.albedo >> (8 * channel) & 255u) - 255 * colour[channel]) > 1.01f;
                }
            }
        }
        EXPECT_GT(compared, 500) << route.name;
        EXPECT_EQ(wrong, 0) << route.name;
    }
}

TEST_F(LayeredDepthMaps, AsArraysGiveTheSameOcclusionBytes) {
    for (const char* nodes : {"depth", "plane"}) {
        std::vector<float> occlusion[2];
        for (int arrays = 0; arrays < 2; ++arrays) {
            SceneRunner run(blocks(), {}, graph_file(k_occlusion),
                            {{"ldm.maps", "40"},
                             {"ldm.resolution", "48"},
                             {"ldm.tilted", "true"},
                             {"ldm.nodes", nodes},
                             {"ambient_occlusion.node_planes", nodes[0] == 'p' ? "true" : "false"},
                             {"ldm.storage", arrays ? "arrays" : "lists"}},
                            {48, 40});
            run.camera = towards_blocks();
            whole_frame(run);
            occlusion[arrays] = run.read("out.ambient_occlusion");
            std::vector<float> near = run.read("out.ambient_occlusion_dmax");
            occlusion[arrays].insert(occlusion[arrays].end(), near.begin(), near.end());
            LdmLists lists(run);
            EXPECT_EQ(lists.info.arrays, arrays);
            if (arrays) { // one after the other without gaps: 4 bytes a fragment less than with links
                EXPECT_EQ(int64_t(lists.words[size_t(lists.info.heads)]), counter(run, "fragments of all maps"));
            }
        }
        EXPECT_EQ(occlusion[0], occlusion[1]) << nodes;
    }
}
