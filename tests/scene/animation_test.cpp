// Interpolation, paths and bounds over time, against closed forms and against dense sampling.

#include "gltf_builder.h"
#include "scene/keyframes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

constexpr float k_half = 0.70710678f;

/// A unit triangle whose node has one animated property.
GltfBuilder animated(const std::vector<float>& times, const std::vector<float>& values, const char* path,
                     const char* interpolation) {
    GltfBuilder b;
    b.triangle();
    int output = std::string(path) == "rotation" ? b.vec4s(values) : b.vec3s(values);
    json sampler{{"input", b.scalars(times)}, {"output", output}, {"interpolation", interpolation}};
    b.add("animations",
          {{"samplers", {sampler}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return b;
}

glm::vec3 origin_at(const Scene& scene, float time, size_t node = 0) {
    return glm::vec3(world_matrices(scene, time)[node][3]);
}

TEST(Animation, LinearTranslation) {
    Scene scene = animated({1, 3}, {0, 0, 0, 4, 2, -2}, "translation", "LINEAR").load();
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].duration, 3);
    EXPECT_TRUE(scene.nodes[0].dynamic);
    EXPECT_EQ(origin_at(scene, 0), glm::vec3(0)); // the first value holds before the first key
    EXPECT_EQ(origin_at(scene, 1.5f), glm::vec3(1, 0.5f, -0.5f));
    EXPECT_EQ(origin_at(scene, 2), glm::vec3(2, 1, -1));
    EXPECT_EQ(origin_at(scene, 3), glm::vec3(0)); // and it starts over
    EXPECT_EQ(origin_at(scene, 3 * 7 + 2), glm::vec3(2, 1, -1));
    EXPECT_EQ(origin_at(scene, -1), glm::vec3(2, 1, -1));
}

TEST(Animation, Step) {
    Scene scene = animated({0, 1, 2}, {0, 0, 0, 5, 0, 0, 9, 0, 0}, "translation", "STEP").load();
    EXPECT_EQ(origin_at(scene, 0.999f).x, 0);
    EXPECT_EQ(origin_at(scene, 1).x, 5);
    EXPECT_EQ(origin_at(scene, 1.999f).x, 5);
}

TEST(Animation, TwoKeysAtOneTimeAreAJump) {
    Scene scene = animated({0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}, "translation", "LINEAR").load();
    EXPECT_NEAR(origin_at(scene, 0.999f).x, 0.999f, 1e-5);
    EXPECT_EQ(origin_at(scene, 1).x, 5);
    EXPECT_EQ(origin_at(scene, 1.5f).x, 5.5f);
}

TEST(Animation, CubicSplineReproducesACubic) {
    // x(t) = t³, y(t) = t² − t, z = 2: in-tangent, value, out-tangent of each key are derivative, value, derivative.
    std::vector<float> times{0, 2, 3}, values;
    for (float t : times) {
        glm::vec3 derivative(3 * t * t, 2 * t - 1, 0), value(t * t * t, t * t - t, 2);
        for (const glm::vec3& v : {derivative, value, derivative})
            values.insert(values.end(), {v.x, v.y, v.z});
    }
    Scene scene = animated(times, values, "translation", "CUBICSPLINE").load();
    for (float t : {0.0f, 0.3f, 1.0f, 1.9f, 2.0f, 2.5f, 2.99f}) {
        glm::vec3 p = origin_at(scene, t);
        EXPECT_NEAR(p.x, t * t * t, 1e-4) << t;
        EXPECT_NEAR(p.y, t * t - t, 1e-4) << t;
        EXPECT_NEAR(p.z, 2, 1e-5) << t;
    }
}

TEST(Animation, RotationsTurnEvenlyAlongTheShorterArc) {
    // 0° to 90° about y; the second key is the same rotation with its sign turned.
    Scene scene = animated({0, 3}, {0, 0, 0, 1, 0, -k_half, 0, -k_half}, "rotation", "LINEAR").load();
    for (float t : {0.0f, 1.0f, 2.0f}) {
        glm::vec3 x = glm::vec3(world_matrices(scene, t)[0] * glm::vec4(1, 0, 0, 0));
        float angle = glm::radians(30.0f * t);
        EXPECT_NEAR(glm::distance(x, glm::vec3(std::cos(angle), 0, -std::sin(angle))), 0, 1e-6) << t;
    }
}

TEST(Animation, CubicRotationsStayUnit) {
    Scene scene = animated({0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, "rotation",
                           "CUBICSPLINE")
                      .load();
    // Halfway the spline gives ½(0,0,0,1) + ⅛(0,2,0,0) + ½(0,1,0,0) − ⅛(0,2,0,0) = (0,½,0,½): 90° about y.
    glm::vec3 x = glm::vec3(world_matrices(scene, 0.5f)[0] * glm::vec4(1, 0, 0, 0));
    EXPECT_NEAR(glm::distance(x, glm::vec3(0, 0, -1)), 0, 1e-6);
    for (float t = 0; t < 1; t += 0.1f)
        EXPECT_NEAR(glm::length(glm::vec3(world_matrices(scene, t)[0][0])), 1, 1e-5);
}

TEST(Animation, InstancesKnowWhereTheyWere) {
    Scene scene = animated({0, 2}, {0, 0, 0, 2, 0, 0}, "translation", "LINEAR").load();
    SceneState state = evaluate_scene(scene, 1.5f, 1.25f);
    ASSERT_EQ(state.instances.size(), 1u);
    EXPECT_TRUE(state.instances[0].dynamic);
    EXPECT_EQ(state.instances[0].world[3].x, 1.5f);
    EXPECT_EQ(state.instances[0].previous_world[3].x, 1.25f);
}

TEST(Animation, ChildrenOfMovingNodesMove) {
    GltfBuilder b = animated({0, 1}, {0, 0, 0, 1, 0, 0}, "translation", "LINEAR");
    b.triangle();
    b.root["nodes"][0]["children"] = {1};
    b.triangle();
    Scene scene = b.load();
    EXPECT_TRUE(scene.nodes[0].dynamic);
    size_t still = 0;
    for (const Node& node : scene.nodes)
        still += !node.dynamic;
    EXPECT_EQ(still, 1u);
}

TEST(Path, IsLinearBetweenKeysAndHoldsOutside) {
    Path path{{{1, {0, 0, 0}, {0, 0, 9}, true}, {3, {2, 4, 0}, {2, 0, 9}, true}, {4, {2, 4, 8}, {2, 0, 9}, true}}};
    EXPECT_EQ(path.at(0).position, glm::dvec3(0));
    EXPECT_EQ(path.at(2).position, glm::dvec3(1, 2, 0));
    EXPECT_EQ(path.at(2).target, glm::dvec3(1, 0, 9));
    EXPECT_EQ(path.at(3).position, glm::dvec3(2, 4, 0));
    EXPECT_EQ(path.at(3.5f).position, glm::dvec3(2, 4, 4));
    EXPECT_EQ(path.at(99).position, glm::dvec3(2, 4, 8));
    EXPECT_TRUE(path.at(99).has_target);
    EXPECT_EQ(Path{}.at(1).position, glm::dvec3(0));
}

TEST(Path, LookRotations) {
    for (glm::vec3 d : {glm::vec3(1, 2, 3), glm::vec3(0, -1, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -5)}) {
        EXPECT_NEAR(glm::distance(look_rotation(d, true) * glm::vec3(0, 0, -1), glm::normalize(d)), 0, 1e-6);
        EXPECT_NEAR(glm::distance(look_rotation(d, false) * glm::vec3(0, 0, 1), glm::normalize(d)), 0, 1e-6);
    }
}

TEST(Environment, DirectionsToTexels) {
    EXPECT_EQ(environment_uv({0, 1, 0}).y, 0);
    EXPECT_FLOAT_EQ(environment_uv({0, -1, 0}).y, 1);
    EXPECT_FLOAT_EQ(environment_uv({1, 0, 0}).x, 0.5f);
    EXPECT_FLOAT_EQ(environment_uv({0, 0, 1}).x, 0.75f);
    EXPECT_FLOAT_EQ(environment_uv({0, 0, -2}).x, 0.25f);
    EXPECT_FLOAT_EQ(environment_uv({1, 1, 0}).y, 0.25f);
}

Bounds dense_bounds(const Scene& scene, float end, int samples) {
    Bounds bounds;
    for (int i = 0; i < samples; ++i)
        bounds.add(scene_bounds(scene, end * float(i) / float(samples)));
    return bounds;
}

/// `found` holds `truth`, and is at most `slack` larger on every side.
void expect_tight(const Bounds& found, const Bounds& truth, float slack) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(found.min[axis], truth.min[axis] + 1e-6f) << axis;
        EXPECT_GE(found.max[axis], truth.max[axis] - 1e-6f) << axis;
        EXPECT_GE(found.min[axis], truth.min[axis] - slack) << axis;
        EXPECT_LE(found.max[axis], truth.max[axis] + slack) << axis;
    }
}

TEST(BoundsOverAnimation, ATurnPassesPointsThatNoKeyHas) {
    // From 0° to 120° about z: corner (1,0,0) passes (0,1,0) and corner (0,1,0) passes (−1,0,0), both between keys.
    float s = std::sin(glm::radians(60.0f)), c = std::cos(glm::radians(60.0f));
    Scene scene = animated({0, 1}, {0, 0, 0, 1, 0, 0, s, c}, "rotation", "LINEAR").load();
    Bounds bounds = scene_bounds_over_animation(scene);
    EXPECT_NEAR(bounds.max.x, 1, 1e-3);
    EXPECT_NEAR(bounds.max.y, 1, 1e-3);
    EXPECT_NEAR(bounds.min.x, -1, 1e-3);
    EXPECT_GE(bounds.max.y, 1);
    EXPECT_LE(bounds.min.x, -1);
    expect_tight(bounds, dense_bounds(scene, 1, 20000), 2e-3f);
}

TEST(BoundsOverAnimation, LinearMotionIsExact) {
    Scene scene = animated({0, 1, 4}, {0, 0, 0, 3, 1, 0, -2, 0, 5}, "translation", "LINEAR").load();
    Bounds bounds = scene_bounds_over_animation(scene);
    EXPECT_NEAR(glm::distance(bounds.min, glm::vec3(-2, 0, 0)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(bounds.max, glm::vec3(4, 2, 5)), 0, 1e-5);
}

TEST(BoundsOverAnimation, SplinesOvershootTheirKeys) {
    // Flat keys with steep tangents: x(s) = 4·(s³ − 2s² + s) + 4·(s³ − s²)·(−1) = 4s(1 − s), whose top is 1 at s = ½.
    Scene scene =
        animated({0, 1}, {0, 0, 0, 0, 0, 0, 4, 0, 0, -4, 0, 0, 0, 0, 0, 0, 0, 0}, "translation", "CUBICSPLINE").load();
    Bounds bounds = scene_bounds_over_animation(scene);
    EXPECT_GE(bounds.max.x, 2);
    EXPECT_LE(bounds.max.x, 2.02f);
    expect_tight(bounds, dense_bounds(scene, 1, 5000), 0.02f);
}

TEST(BoundsOverAnimation, NestedTurnsAndUnequalLoops) {
    // An arm that turns in 2 s, on its end a hand that turns the other way in 3 s: they meet again after 6 s.
    GltfBuilder b;
    b.triangle(json::object(), {{"translation", {3, 0, 0}}});
    b.node({{"children", {0}}});
    auto turn = [&](int node, float seconds, float sign, int axis) {
        std::vector<float> values;
        for (float angle : {0.0f, 120.0f, 240.0f, 360.0f}) {
            glm::vec4 q(0, 0, 0, std::cos(glm::radians(0.5f * angle)));
            q[axis] = sign * std::sin(glm::radians(0.5f * angle));
            values.insert(values.end(), {q.x, q.y, q.z, q.w});
        }
        json sampler{{"input", b.scalars({0, seconds / 3, 2 * seconds / 3, seconds})}, {"output", b.vec4s(values)}};
        b.add("animations", {{"samplers", {sampler}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}}}}});
    };
    turn(1, 2, 1, 2);
    turn(0, 3, -1, 1);
    Scene scene = b.load();
    expect_tight(scene_bounds_over_animation(scene), dense_bounds(scene, 6, 20000), 0.02f);
}

TEST(BoundsOverAnimation, Paths) {
    GltfBuilder b;
    b.triangle();
    b.triangle();
    Scene scene = b.load();
    scene.nodes[1].path.keys = {{0, {0, 0, 0}, {5, 0, 0}, true}, {10, {0, 0, -4}, {-5, 0, 0}, true}};
    scene.nodes[1].dynamic = true;
    expect_tight(scene_bounds_over_animation(scene), dense_bounds(scene, 10.001f, 20000), 0.01f);
}

TEST(BoundsOverAnimation, NothingMoves) {
    GltfBuilder b;
    b.triangle();
    Scene scene = b.load();
    Bounds bounds = scene_bounds_over_animation(scene);
    EXPECT_EQ(bounds.min, glm::vec3(0));
    EXPECT_EQ(bounds.max, glm::vec3(1, 1, 0));
    EXPECT_TRUE(scene_bounds_over_animation(Scene{}).empty());
}

} // namespace
} // namespace bounce::testing
