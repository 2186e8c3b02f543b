// Real files: Khronos' samples and the scenes of the field, where they are there.

#include "gltf_builder.h"
#include "scene/default_view.h"
#include "scene/describe.h"

#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

#define SCENE_OR_SKIP(variable, name)                                                                                  \
    fs::path variable = shared_scene(name);                                                                            \
    if (variable.empty()) GTEST_SKIP() << "the test scene " name " is not beside the source tree"

void expect_box(const Bounds& bounds, const glm::vec3& min, const glm::vec3& max) {
    EXPECT_NEAR(glm::distance(bounds.min, min), 0, 1e-4);
    EXPECT_NEAR(glm::distance(bounds.max, max), 0, 1e-4);
}

TEST(Khronos, Box) {
    SCENE_OR_SKIP(folder, "khronos/Box");
    Scene scene = load_gltf(find_scene("glTF/Box.gltf", folder));
    EXPECT_EQ(scene_facts(scene).triangles, 12u);
    EXPECT_TRUE(scene.notes.empty());
    expect_box(scene_bounds(scene, 0), glm::vec3(-0.5f), glm::vec3(0.5f));
}

TEST(Khronos, SparseAccessor) {
    SCENE_OR_SKIP(folder, "khronos/SimpleSparseAccessor");
    Scene scene = load_gltf(find_scene("glTF/SimpleSparseAccessor.gltf", folder));
    // Two rows of vertices at y = 0 and 1; three of the upper ones are lifted, the highest to 4.
    Bounds bounds = scene_bounds(scene, 0);
    EXPECT_FLOAT_EQ(bounds.max.y, 4);
    EXPECT_FLOAT_EQ(bounds.max.x, 6);
}

TEST(Khronos, TriangleWithoutIndices) {
    SCENE_OR_SKIP(folder, "khronos/TriangleWithoutIndices");
    Scene scene = load_gltf(find_scene("glTF/TriangleWithoutIndices.gltf", folder));
    EXPECT_EQ(scene.indices.size(), 3u);
    expect_box(scene_bounds(scene, 0), glm::vec3(0), glm::vec3(1, 1, 0));
}

TEST(Khronos, VertexColours) {
    SCENE_OR_SKIP(folder, "khronos/BoxVertexColors");
    Scene scene = load_gltf(find_scene("glTF/BoxVertexColors.gltf", folder));
    bool coloured = false;
    for (const Vertex& v : scene.vertices)
        coloured = coloured || v.colour_rg != 0xffffffffu;
    EXPECT_TRUE(coloured);
}

TEST(Khronos, Cameras) {
    SCENE_OR_SKIP(folder, "khronos/Cameras");
    Scene scene = load_gltf(find_scene("glTF/Cameras.gltf", folder));
    EXPECT_EQ(evaluate_scene(scene, 0, 0).cameras.size(), 2u);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("orthographic")));
}

TEST(Khronos, AnimatedCube) {
    SCENE_OR_SKIP(folder, "khronos/AnimatedCube");
    Scene scene = load_gltf(find_scene("glTF/AnimatedCube.gltf", folder));
    EXPECT_EQ(scene.animations.size(), 1u);
    // A cube of side 2 that turns about y: at some time its diagonal lies along x.
    Bounds bounds = scene_bounds_over_animation(scene);
    EXPECT_NEAR(bounds.max.x, std::sqrt(2.0f), 2e-3);
    EXPECT_GE(bounds.max.x, std::sqrt(2.0f) - 1e-6f);
    EXPECT_NEAR(bounds.max.y, 1, 1e-3);
}

TEST(Khronos, EveryFileLoads) {
    SCENE_OR_SKIP(root, "khronos");
    size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        ++files;
        EXPECT_NO_THROW(EXPECT_GT(scene_facts(load_gltf(entry.path())).triangles, 0u)) << entry.path();
    }
    EXPECT_GE(files, 9u);
}

TEST(Scenes, Sponza) {
    SCENE_OR_SKIP(file, "sponza/Sponza.gltf");
    Shot shot = load_shot(file.string());
    SceneFacts facts = shot_facts(shot);
    EXPECT_EQ(facts.triangles, 262267u);
    EXPECT_EQ(facts.textures, 69u);
    EXPECT_EQ(facts.alpha_tested_materials, 3u);
    EXPECT_EQ(facts.materials, 25u);
    EXPECT_NEAR(facts.bounds.size().x, 29.8f, 0.2f);
    size_t large = 0;
    for (const Texture& texture : shot.scene.textures)
        large += texture.image.width == 512;
    EXPECT_EQ(large, 68u); // and one of 4 × 4
    // The view is from within, and looks along the nave.
    EXPECT_GT(shot.camera.position.x, facts.bounds.min.x);
    EXPECT_LT(shot.camera.position.x, facts.bounds.max.x);
    glm::vec3 forward = glm::normalize(shot.camera.target - shot.camera.position);
    EXPECT_GT(std::abs(forward.x), 0.7f);
}

TEST(Scenes, Sibenik) {
    SCENE_OR_SKIP(file, "sibenik/Sibenik.gltf");
    Shot shot = load_shot(file.string());
    SceneFacts facts = shot_facts(shot);
    EXPECT_EQ(facts.triangles, 75284u);
    EXPECT_EQ(facts.point_lights, 1u);      // sunlight would not get in
    EXPECT_GT(facts.blended_materials, 0u); // its glass
    // Normal maps without authored tangents: made, unit and orthogonal.
    for (const Vertex& v : shot.scene.vertices) {
        ASSERT_NEAR(glm::length(glm::vec3(v.tangent)), 1, 1e-3);
        ASSERT_NEAR(glm::length(v.normal), 1, 1e-3);
        ASSERT_NEAR(glm::dot(glm::vec3(v.tangent), v.normal), 0, 2e-3);
    }
}

TEST(Scenes, HairballIsAMillionTrianglesInFewDraws) {
    Shot shot = load_shot("hairball");
    SceneFacts facts = shot_facts(shot);
    EXPECT_GE(facts.triangles, 1'000'000u);
    EXPECT_LE(facts.instances, 300u);
    EXPECT_EQ(facts.spot_lights, 1u);
    EXPECT_TRUE(shot.scene.notes.empty());
    EXPECT_GE(facts.bounds.min.y, 0) << "the hair goes through the floor";
    // Thin: the mean triangle is a millionth of the scene's size squared and less.
    double area = 0;
    size_t count = 0;
    for (size_t i = 6; i + 2 < shot.scene.indices.size(); i += 3, ++count) { // after the floor
        auto corner = [&](size_t k) { return shot.scene.vertices[shot.scene.indices[i + k]].position; };
        area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    EXPECT_LT(area / double(count), 1e-3);
}

TEST(Scenes, DefaultViews) {
    SCENE_OR_SKIP(root, "cornell-mcguire");
    auto kind = [](const char* name) { return default_view(load_gltf(shared_scene(name)), 16.0f / 9).kind; };
    EXPECT_EQ(kind("cornell-mcguire/CornellBox-Sphere.gltf"), ViewKind::open_box);
    EXPECT_EQ(kind("dragon/dragon.gltf"), ViewKind::outside);
    EXPECT_EQ(kind("bunny/bunny.gltf"), ViewKind::outside);
    EXPECT_EQ(kind("conference/Conference.gltf"), ViewKind::inside);
}

} // namespace
} // namespace bounce::testing
