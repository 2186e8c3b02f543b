// Bounds without strays: what is left out, what is not, and that nothing changes where nothing strays.

#include "gltf_builder.h"
#include "scene/describe.h"
#include "scene/extent.h"

#include <cmath>
#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A scene of triangles in memory; one mesh and node for each call of `begin`.
class Made {
  public:
    Made& begin(glm::vec3 emission = glm::vec3(0)) {
        scene.nodes.emplace_back().mesh = int(scene.meshes.size());
        Primitive primitive;
        primitive.first_index = uint32_t(scene.indices.size());
        primitive.material = int(scene.materials.size());
        scene.meshes.emplace_back().primitives.push_back(primitive);
        scene.materials.emplace_back().emission = emission;
        return *this;
    }
    Made& triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        for (glm::vec3 p : {a, b, c}) {
            scene.indices.push_back(uint32_t(scene.vertices.size()));
            scene.vertices.emplace_back().position = p;
        }
        scene.meshes.back().primitives[0].index_count += 3;
        return *this;
    }
    /// The six sides of a box, each of 2·n² triangles.
    Made& box(glm::vec3 low, glm::vec3 high, int n = 1) {
        for (int axis = 0; axis < 3; ++axis)
            for (float side : {low[axis], high[axis]})
                for (int i = 0; i < n * n; ++i) {
                    auto corner = [&](int du, int dv) {
                        glm::vec3 p;
                        int u = (axis + 1) % 3, v = (axis + 2) % 3;
                        p[axis] = side;
                        p[u] = glm::mix(low[u], high[u], float(i % n + du) / float(n));
                        p[v] = glm::mix(low[v], high[v], float(i / n + dv) / float(n));
                        return p;
                    };
                    triangle(corner(0, 0), corner(1, 0), corner(1, 1));
                    triangle(corner(0, 0), corner(1, 1), corner(0, 1));
                }
        return *this;
    }
    /// The last node moves through these places, one a second.
    Made& move(const std::vector<glm::vec3>& places) {
        Animation animation;
        animation.duration = float(places.size() - 1);
        AnimationChannel channel;
        channel.node = int(scene.nodes.size()) - 1;
        for (size_t i = 0; i < places.size(); ++i) {
            channel.times.push_back(float(i));
            channel.values.emplace_back(places[i], 0);
        }
        scene.nodes.back().dynamic = true;
        animation.channels.push_back(channel);
        scene.animations.push_back(animation);
        return *this;
    }
    Scene scene;
};

/// A room of 4 × 3 × 4 m with two blocks in it: 36 triangles.
Made room() {
    return Made().begin().box({-2, 0, -2}, {2, 3, 2}).box({-1, 0, -1}, {0, 1, 0}).box({0.5f, 0, 0.5f}, {1, 2, 1});
}

void expect_room(const SceneExtent& extent) {
    EXPECT_EQ(extent.bounds.min, glm::vec3(-2, 0, -2));
    EXPECT_EQ(extent.bounds.max, glm::vec3(2, 3, 2));
}

TEST(Extent, WithoutStraysItIsTheBounds) {
    SceneExtent extent = scene_extent(room().scene, 0);
    expect_room(extent);
    EXPECT_EQ(extent.whole.min, extent.bounds.min);
    EXPECT_EQ(extent.whole.max, extent.bounds.max);
    EXPECT_EQ(extent.triangles, 36u);
    EXPECT_FALSE(extent.strays());
    EXPECT_TRUE(scene_extent(Scene{}, 0).bounds.empty());
    EXPECT_TRUE(scene_extent_over_animation(Scene{}).bounds.empty());
}

TEST(Extent, OneVertexFarAway) {
    for (float far : {2e3f, 1e6f, 1e12f, 1e19f, 3e37f})
        for (int k : {0, 1, 2}) {
            Made made = room();
            made.scene.vertices[size_t(3 * 20 + k)].position = glm::vec3(0.3f, 1, -1) * far;
            SceneExtent extent = scene_extent(made.scene, 0);
            expect_room(extent);
            EXPECT_EQ(extent.stray_triangles, 1u) << far;
            EXPECT_GE(longest_edge(extent.whole), 0.9f * far);
        }
}

TEST(Extent, OneVertexOfADenseMesh) {
    Made made = Made().begin().box({-1, -1, -1}, {1, 1, 1}, 20);
    // The corner that six triangles of one side share, moved as a welded mesh would have it.
    glm::vec3 shared = made.scene.vertices[3 * 100].position;
    size_t moved = 0;
    for (size_t i = 0; i < made.scene.vertices.size(); ++i)
        if (made.scene.vertices[i].position == shared) made.scene.vertices[i].position.y = 1e7f, ++moved;
    ASSERT_GE(moved, 3u);
    SceneExtent extent = scene_extent(made.scene, 0);
    EXPECT_EQ(extent.bounds.max, glm::vec3(1));
    EXPECT_EQ(extent.stray_triangles, moved);
}

TEST(Extent, OneHugeTriangle) {
    // Through the room, beside it, and so far off that the room is no part of its area to speak of.
    const glm::vec3 offsets[] = {{0, 0, 0}, {0, -1e3f, 0}, {5e6f, 0, 0}};
    for (glm::vec3 at : offsets) {
        Made made = room();
        made.triangle(at + glm::vec3(-1e6f, 0, -1e6f), at + glm::vec3(1e6f, 0, -1e6f), at + glm::vec3(0, 0, 1e6f));
        SceneExtent extent = scene_extent(made.scene, 0);
        expect_room(extent);
        EXPECT_EQ(extent.stray_triangles, 1u);
    }
}

TEST(Extent, StraysOfSeveralSizes) {
    Made made = room();
    for (float far : {1e4f, 1e9f, 1e15f})
        made.triangle({0, 0, 0}, {0.1f, 0, 0}, {0, far, 0});
    SceneExtent extent = scene_extent(made.scene, 0);
    expect_room(extent);
    EXPECT_EQ(extent.stray_triangles, 3u);
}

TEST(Extent, AFlatFloorAndASliver) {
    Made made =
        Made().begin().triangle({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}).triangle({-1, 0, -1}, {1, 0, 1}, {1, 0, -1});
    made.begin().triangle({0, 0.1f, 0}, {0.1f, 0.1f, 0}, {0, 1e19f, 0});
    SceneExtent extent = scene_extent(made.scene, 0);
    EXPECT_EQ(extent.bounds.min, glm::vec3(-1, 0, -1));
    EXPECT_EQ(extent.bounds.max, glm::vec3(1, 0, 1));
}

TEST(Extent, ADegenerateTriangleFarAway) {
    Made made = room();
    made.triangle({1, 1, 1}, {1, 1, 1}, {1, 4e4f, 1});
    made.triangle({5e4f, 0, 0}, {5e4f, 0, 0}, {5e4f, 0, 0});
    SceneExtent extent = scene_extent(made.scene, 0);
    expect_room(extent);
    EXPECT_EQ(extent.stray_triangles, 2u);
}

TEST(Extent, OneTinyObjectFarAway) {
    for (int n : {1, 20}) { // however many triangles it has
        Made made = room();
        made.begin().box({300, 5, 0}, {300.01f, 5.01f, 0.01f}, n);
        SceneExtent extent = scene_extent(made.scene, 0);
        expect_room(extent);
        EXPECT_EQ(extent.stray_triangles, size_t(12 * n * n));
        EXPECT_FLOAT_EQ(extent.whole.max.x, 300.01f);
    }
}

TEST(Extent, WhatHoldsMoreOfTheAreaBelongs) {
    Made made = room();
    made.begin().box({300, 0, 0}, {301, 1, 1}); // 6 of about 100 m²
    EXPECT_FLOAT_EQ(scene_extent(made.scene, 0).bounds.max.x, 301);
}

TEST(Extent, WhatIsNotFarAwayBelongs) {
    Made made = room();
    made.begin().box({6, 1, 0}, {6.01f, 1.01f, 0.01f}); // the bounds would shrink to half
    EXPECT_FLOAT_EQ(scene_extent(made.scene, 0).bounds.max.x, 6.01f);
    // A floor that is large, but in which the rest is more than a voxel.
    Made on_floor = room();
    on_floor.triangle({-200, 0, -200}, {200, 0, -200}, {0, 0, 200});
    EXPECT_FLOAT_EQ(scene_extent(on_floor.scene, 0).bounds.max.x, 200);
}

TEST(Extent, ALampFarAwayBelongs) {
    Made made = room();
    made.begin(glm::vec3(50)).box({300, 5, 0}, {300.01f, 5.01f, 0.01f});
    EXPECT_FLOAT_EQ(scene_extent(made.scene, 0).bounds.max.x, 300.01f);
}

TEST(Extent, ACameraThatSeesTheWholeKeepsIt) {
    Made made = Made().begin().box({-1, 0, -1}, {1, 1, 1}, 4);
    made.triangle({-1e6f, 0, -1e6f}, {1e6f, 0, -1e6f}, {0, 0, 1e6f});
    Camera camera;
    camera.vfov = 0.8f;
    camera.position = {0, 2, 8};
    EXPECT_EQ(scene_extent(made.scene, 0, {&camera, 1}).bounds.max.x, 1);
    camera.position = {0, 1e5f, 1e5f};
    EXPECT_EQ(scene_extent(made.scene, 0, {&camera, 1}).bounds.max.x, 1e6f);
}

TEST(Extent, AHugeFloorAloneIsTheScene) {
    Made made = Made().begin().triangle({-2500, 0, -2500}, {-2500, 0, 2500}, {2500, 0, 2500});
    made.triangle({-2500, 0, -2500}, {2500, 0, 2500}, {2500, 0, -2500});
    EXPECT_EQ(scene_extent(made.scene, 0).bounds.max.x, 2500);
}

TEST(Extent, ScaledScenesAreAlike) {
    for (float scale : {1e-9f, 1e-3f, 1e6f}) {
        Made made = room();
        made.triangle({0, 0, 0}, {0.1f, 0, 0}, {0, 1e6f, 0});
        made.begin().box({300, 5, 0}, {300.01f, 5.01f, 0.01f});
        for (Vertex& vertex : made.scene.vertices)
            vertex.position *= scale;
        SceneExtent extent = scene_extent(made.scene, 0);
        EXPECT_FLOAT_EQ(extent.bounds.max.x, 2 * scale);
        EXPECT_EQ(extent.stray_triangles, 13u);
    }
}

TEST(Extent, AnObjectThatFliesAwayForAMoment) {
    Made made = room();
    made.begin().box({0, 2, 0}, {0.2f, 2.2f, 0.2f});
    made.move({{0, 0, 0}, {1, 0, 0}, {1, 0, 0.5f}, {1e6f, 0, 0}, {0, 0, 0}, {0, 0.3f, 0}});
    SceneExtent extent = scene_extent_over_animation(made.scene);
    expect_room(extent);
    EXPECT_GT(extent.stray_moving_boxes, 0u);
    EXPECT_FLOAT_EQ(extent.whole.max.x, 1e6f + 0.2f);
    EXPECT_EQ(extent.whole.max, scene_bounds_over_animation(made.scene).max);
    SceneFacts facts = scene_facts(made.scene);
    EXPECT_EQ(facts.bounds_over_animation.max, glm::vec3(2, 3, 2));
    EXPECT_THAT(describe_strays(facts), HasSubstr("moving geometry strays"));
}

TEST(Extent, AStrayVertexOfAMovingObject) {
    Made made = room();
    made.begin().box({0, 2, 0}, {0.2f, 2.2f, 0.2f}, 3).triangle({0, 2, 0}, {0.1f, 2, 0}, {0, 1e7f, 0});
    made.move({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}});
    SceneExtent extent = scene_extent_over_animation(made.scene);
    expect_room(extent);
    EXPECT_GT(extent.whole.max.y, 9e6f);
}

TEST(Extent, AStillStrayBesideMovingObjects) {
    Made made = room();
    made.triangle({0, 0, 0}, {0.1f, 0, 0}, {0, 1e7f, 0});
    made.begin().box({0, 2, 0}, {0.2f, 2.2f, 0.2f}).move({{0, 0, 0}, {4, 0, 0}});
    SceneExtent extent = scene_extent_over_animation(made.scene);
    EXPECT_FLOAT_EQ(extent.bounds.max.x, 4.2f); // where it moves to belongs
    EXPECT_EQ(extent.bounds.max.y, 3);
    EXPECT_EQ(extent.stray_triangles, 1u);
}

TEST(Extent, ASceneThatMovesAsAWholeIsNoStray) {
    Made made = room().move({{0, 0, 0}, {1e5f, 0, 0}});
    SceneExtent extent = scene_extent_over_animation(made.scene);
    EXPECT_FALSE(extent.strays());
    EXPECT_GE(extent.bounds.max.x, 1e5f);
}

TEST(Extent, FactsAndInfoSayWhatIsLeftOut) {
    Made made = room();
    made.triangle({0, 0, 0}, {0.1f, 0, 0}, {0, 4e6f, 0});
    SceneFacts facts = scene_facts(made.scene);
    EXPECT_EQ(facts.bounds.max, glm::vec3(2, 3, 2));
    EXPECT_EQ(facts.bounds_over_animation.max, glm::vec3(2, 3, 2));
    EXPECT_FLOAT_EQ(facts.whole_bounds.max.y, 4e6f);
    EXPECT_EQ(facts.stray_triangles, 1u);
    EXPECT_THAT(describe_strays(facts), HasSubstr("1 triangle strays 1e+06 times as far"));
    Shot shot;
    shot.scene = made.scene;
    shot.camera.position = {0, 1, 5};
    EXPECT_THAT(describe_scene(shot), HasSubstr("left out"));
    shot.scene = room().scene;
    EXPECT_THAT(describe_scene(shot), Not(HasSubstr("left out")));
}

TEST(Extent, DefaultViewsLookAtWhatIsLeft) {
    // The same files with and without a stray get the same view and light.
    auto load = [](bool stray) {
        GltfBuilder b;
        std::vector<float> positions{-1, 0, -1, -1, 0, 1, 1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, -1};
        b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3s(positions)}}}})}});
        if (stray)
            b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3s({0, 0, 0, 0, 0, .1f, 0, 1e7f, 0})}}}})}});
        TempFolder folder;
        return load_shot(folder.write("stray.gltf", b.text()).string());
    };
    Shot with = load(true), without = load(false);
    // The stray may give the file a unit of its own to be loaded in: compare where things lie in the file.
    const auto expect_same = [&](const glm::vec3& a, const glm::vec3& b) {
        const glm::dvec3 file_a = with.scene.space.to_file(a), file_b = without.scene.space.to_file(b);
        EXPECT_LT(glm::distance(file_a, file_b), 1e-5) << file_a.x << " " << file_b.x;
    };
    expect_same(with.camera.position, without.camera.position);
    expect_same(with.camera.target, without.camera.target);
    expect_same(shot_facts(with).bounds.max, shot_facts(without).bounds.max);
}

} // namespace
} // namespace bounce::testing
