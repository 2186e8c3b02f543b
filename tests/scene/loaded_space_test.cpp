// Where scenes are loaded: far from the file's origin and at any size, without losing what the file's numbers tell.

#include "gltf_builder.h"
#include "scene/loaded_space.h"

#include <cmath>
#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class LoadedSpaceTest : public ::testing::Test {
  protected:
    /// A triangle of side `size` whose vertices lie at `by` (mesh) below a node at `at`.
    void triangle(const glm::dvec3& at, float size = 1, const glm::vec3& by = glm::vec3(0)) {
        GltfBuilder b;
        json primitive{{"attributes",
                        {{"POSITION", b.vec3s({by.x, by.y, by.z, by.x + size, by.y, by.z, by.x, by.y + size, by.z})}}}};
        b.node({{"mesh", b.mesh(primitive)}, {"translation", {at.x, at.y, at.z}}});
        folder.write("scene.gltf", b.text());
    }
    Shot load(json shot) {
        shot["scene"] = "scene.gltf";
        return load_shot(folder.write("shot.json", shot.dump()).string());
    }
    std::string error(const json& shot) {
        try {
            load(shot);
        } catch (const Error& problem) {
            return problem.what();
        }
        ADD_FAILURE() << "loaded, but an Error was expected";
        return "";
    }
    /// The drawn corners, loaded.
    static std::vector<glm::vec3> corners(const Shot& shot) {
        std::vector<glm::vec3> out;
        for (const Instance& instance : evaluate_shot(shot, 0).scene.instances)
            for (uint32_t i = 0; i < instance.primitive.index_count; ++i) {
                const uint32_t vertex = shot.scene.indices[instance.primitive.first_index + i];
                out.emplace_back(instance.world * glm::vec4(shot.scene.vertices[vertex].position, 1));
            }
        return out;
    }
    TempFolder folder;
};

TEST_F(LoadedSpaceTest, OrdinaryScenesStayAsTheyAre) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(3, -2, 0.1), glm::dvec3(14, 0, 0)}) {
        triangle(at);
        Shot shot = load({{"camera", {{"position", {0.1, 2, 5}}, {"target", {0, 0, 0}}}}});
        EXPECT_EQ(shot.scene.space, LoadedSpace{});
        EXPECT_EQ(shot.camera.position, glm::vec3(0.1f, 2, 5));
    }
}

/// What is drawn, lit and looked at from moves together, and is told to the last digit that floats have near zero.
TEST_F(LoadedSpaceTest, EverythingFollowsAFarScene) {
    const glm::dvec3 far(1e6 + 0.3, -2e6, 5e5);
    auto place = [&](double x, double y, double z) { return json{far.x + x, far.y + y, far.z + z}; };
    triangle(far);
    Shot shot =
        load({{"camera", {{"position", place(0.1, 0.2, 5)}, {"target", place(0.1, 0.2, 0)}}},
              {"lights",
               {{{"type", "point"}, {"position", place(0.25, 3, 0.125)}},
                {{"type", "spot"}, {"position", place(1, 1, 1)}, {"target", place(1, 1, 0)}},
                {{"type", "point"},
                 {"path", {{{"t", 0}, {"position", place(0, 1, 0)}}, {{"t", 1}, {"position", place(0, 2, 0)}}}}}}},
              {"objects", {{{"scene", "scene.gltf"}, {"position", {0.5, 0, 0}}}}}});
    const LoadedSpace& space = shot.scene.space;
    EXPECT_NE(space, LoadedSpace{});
    EXPECT_EQ(space.unit, 1);
    EXPECT_LT(glm::length(space.origin - far), 4);
    const glm::vec3 start = space.to_loaded(far);
    ShotState state = evaluate_shot(shot, 30);
    auto near = [&](const glm::vec3& loaded, const glm::vec3& wanted) {
        return glm::length(loaded - start - wanted) < 1e-6f;
    };
    EXPECT_TRUE(near(state.camera.position, {0.1f, 0.2f, 5}));
    ASSERT_EQ(state.scene.lights.size(), 3u);
    EXPECT_TRUE(near(state.scene.lights[0].position, {0.25f, 3, 0.125f}));
    EXPECT_LT(glm::length(state.scene.lights[1].direction - glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_TRUE(near(state.scene.lights[2].position, {0, 1.5f, 0}));
    const std::vector<glm::vec3> drawn = corners(shot);
    ASSERT_EQ(drawn.size(), 6u);
    EXPECT_TRUE(near(drawn[1], {1, 0, 0}));
    EXPECT_TRUE(near(drawn[4], {1.5f, 0, 0}));
    // And people read what they typed.
    json said = json::parse(camera_json(shot.camera, space));
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(said["position"][size_t(axis)].get<double>(),
                    far[axis] + (axis == 2   ? 5
                                 : axis == 1 ? 0.2
                                             : 0.1),
                    1e-6);
}

TEST_F(LoadedSpaceTest, VerticesFarFromTheirNodeAreMovedToIt) {
    triangle(glm::dvec3(0), 1, glm::vec3(65536, -131072, 8192));
    Shot shot = load({{"camera", {{"position", {65536, -131072, 8197}}, {"target", {65536, -131072, 8192}}}}});
    for (const Vertex& vertex : shot.scene.vertices)
        EXPECT_LE(glm::length(vertex.position), 4) << "vertices are told near zero, where turns lose nothing";
    const std::vector<glm::vec3> drawn = corners(shot);
    EXPECT_EQ(drawn[1] - drawn[0], glm::vec3(1, 0, 0));
    EXPECT_EQ(shot.camera.position - drawn[0], glm::vec3(0, 0, 5));
}

TEST_F(LoadedSpaceTest, ANodeFarAwayWhoseChildLeadsBackIsNear) {
    GltfBuilder b;
    json primitive{{"attributes", {{"POSITION", b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}};
    b.root["scenes"] = {{{"nodes", {1}}}};
    b.node({{"mesh", b.mesh(primitive)}, {"translation", {-1e9 + 0.3, 0, 0}}});
    b.node({{"children", {0}}, {"translation", {1e9, 0, 0}}});
    folder.write("scene.gltf", b.text());
    Shot shot = load({{"camera", {{"position", {0, 0, 5}}, {"target", {0, 0, 0}}}}});
    EXPECT_EQ(shot.scene.space, LoadedSpace{});
    EXPECT_NEAR(corners(shot)[0].x, 0.3, 1e-6);
}

TEST_F(LoadedSpaceTest, AStrayVertexDoesNotDecide) {
    GltfBuilder b;
    std::vector<float> positions;
    for (int i = 0; i < 300; ++i)
        for (float corner : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f})
            positions.push_back(corner + float(i % 7));
    for (int axis = 0; axis < 3; ++axis)
        positions[size_t(axis)] = 1e12f;
    json primitive{{"attributes", {{"POSITION", b.vec3s(positions)}}}};
    b.node({{"mesh", b.mesh(primitive)}, {"translation", {4e5, 0, 0}}});
    folder.write("scene.gltf", b.text());
    Shot shot = load({{"camera", {{"position", {4e5, 0, 5}}, {"target", {4e5, 0, 0}}}}});
    EXPECT_NEAR(shot.scene.space.origin.x, 4e5, 8);
    EXPECT_EQ(shot.scene.space.unit, 1);
}

/// In a scene of three triangles, too, be the stray one long or far.
TEST_F(LoadedSpaceTest, AStrayAmongFewTrianglesDoesNotDecide) {
    for (float far : {1e7f, 1e12f, 1e18f, 1e19f, 1e30f})
        for (float near : {0.0f, far}) {
            GltfBuilder b;
            json primitive{{"attributes", {{"POSITION", b.vec3s({-1, 0,    -1, 1,    0,    -1, 1,  0,   1, //
                                                                 -1, 0,    -1, 1,    0,    1,  -1, 0,   1, //
                                                                 0,  near, 0,  0.1f, near, 0,  0,  far, 0})}}}};
            b.node({{"mesh", b.mesh(primitive)}, {"translation", {3e5, 0, 0}}});
            folder.write("scene.gltf", b.text());
            const json camera{{"position", {3e5, 2, 2}}, {"target", {3e5, 0, 0}}};
            if (far > 1e19f) {
                EXPECT_THAT(error({{"camera", camera}}), HasSubstr("expected vertices whose distances")) << far;
                continue;
            }
            Shot shot = load({{"camera", camera}});
            EXPECT_EQ(shot.scene.space.unit, 1) << far;
            EXPECT_NEAR(shot.scene.space.origin.x, 3e5, 2) << far;
            EXPECT_EQ(corners(shot)[1] - corners(shot)[0], glm::vec3(2, 0, 0)) << far;
        }
}

/// A scene of any size becomes one of about a metre; what its lights send through a unit of solid angle stays the same.
TEST_F(LoadedSpaceTest, ExtremeSizesGetAUnitOfTheirOwn) {
    for (double size : {1e-18, 1e-12, 1e9, 1e14}) {
        triangle(glm::dvec3(0), float(size));
        Shot shot =
            load({{"camera", {{"position", {0, 0, 5 * size}}, {"target", {0, 0, 0}}}},
                  {"lights", {{{"type", "point"}, {"position", {0, 0, 2 * size}}, {"intensity", 3 * size * size}}}}});
        const double unit = shot.scene.space.unit;
        EXPECT_NEAR(size / unit, 1, 0.42) << size;
        EXPECT_EQ(std::exp2(std::round(std::log2(unit))), unit) << "a power of two";
        EXPECT_NEAR(shot.camera.position.z, 5 * size / unit, 1e-5);
        Light light = evaluate_shot(shot, 0).scene.lights[0];
        EXPECT_NEAR(light.position.z * unit, 2 * size, 1e-6 * size);
        EXPECT_NEAR(double(light.intensity.r) * unit * unit / (3 * size * size), 1, 1e-5);
        EXPECT_NEAR(corners(shot)[1].x * unit, size, 1e-6 * size);
        // Panels and files show the file's own.
        EXPECT_EQ(shot.scene.lights[0].intensity.r, float(3 * size * size));
    }
}

TEST_F(LoadedSpaceTest, WhatFloatsDoNotReachIsRefused) {
    triangle(glm::dvec3(0));
    EXPECT_THAT(error({{"camera", {{"position", {1e30, 0, 0}}, {"target", {0, 0, 0}}}}}),
                AllOf(HasSubstr("the shot's camera"), HasSubstr("expected coordinates within")));
    EXPECT_THAT(error({{"camera", {{"position", {0, 0, 1}}, {"target", {0, 0, 0}}}},
                       {"lights", {{{"type", "point"}, {"position", {0, 1e25, 0}}, {"name", "sun"}}}}}),
                AllOf(HasSubstr("'sun'"), HasSubstr("expected coordinates within")));
    EXPECT_THAT(error({{"camera", {{"position", {0, 0, 1e6}}, {"target", {0, 0, 1e6 + 1e-9}}}}}),
                HasSubstr("floats cannot tell them apart"));
    triangle(glm::dvec3(0), 1e-20f);
    EXPECT_THAT(
        error({{"camera", {{"position", {0, 0, 1e-20}}, {"target", {0, 0, 0}}}},
               {"lights", {{{"type", "point"}, {"position", {0, 1e-20, 0}}, {"intensity", 3}, {"name", "lamp"}}}}}),
        AllOf(HasSubstr("intensity of light 'lamp'"), HasSubstr("expected")));
    triangle(glm::dvec3(0), 1e30f);
    Shot large = load({{"camera", {{"position", {0, 0, 1e30}}, {"target", {0, 0, 0}}}}});
    EXPECT_NEAR(large.camera.position.z * large.scene.space.unit / 1e30, 1, 1e-6);
}

TEST(LoadedSpace, PlacesInTheFileHaveFewDigitsAndAreLoadedAsTheyWere) {
    const glm::vec3 loaded(2.78f, 0.1f, -8);
    EXPECT_EQ(place_in_file({}, loaded), glm::dvec3(2.78, 0.1, -8));
    EXPECT_EQ(LoadedSpace{}.to_loaded(place_in_file({}, loaded)), loaded);
    const LoadedSpace far{{1e6, 0, 0}, 0.25};
    EXPECT_EQ(place_in_file(far, loaded), far.to_file(loaded));
}

} // namespace
} // namespace bounce::testing
