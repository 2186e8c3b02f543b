// Primitives: strips and fans, normals and tangents made, sharing, and what is left out.

#include "gltf_builder.h"
#include "scene/shading_frame.h"

#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

std::vector<glm::vec3> corners(const Scene& scene) {
    std::vector<glm::vec3> out;
    for (uint32_t index : scene.indices)
        out.push_back(scene.vertices[index].position);
    return out;
}

TEST(Mesh, StripsTurnOverEverySecondTriangle) {
    GltfBuilder b;
    int positions = b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}})}});
    Scene scene = b.load();
    ASSERT_EQ(scene.indices.size(), 9u);
    // All of them turn the same way: toward +z.
    for (const Vertex& v : scene.vertices)
        EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(corners(scene)[3], glm::vec3(1, 0, 0));
    EXPECT_EQ(corners(scene)[4], glm::vec3(1, 1, 0));
    EXPECT_EQ(corners(scene)[5], glm::vec3(0, 1, 0));
}

TEST(Mesh, FansShareTheirFirstVertex) {
    GltfBuilder b;
    int positions = b.vec3s({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}})}});
    Scene scene = b.load();
    ASSERT_EQ(scene.indices.size(), 6u);
    for (const Vertex& v : scene.vertices)
        EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(corners(scene)[2], glm::vec3(0));
    EXPECT_EQ(corners(scene)[5], glm::vec3(0));
}

TEST(Mesh, PointsAndLinesAreLeftOutAndSaid) {
    GltfBuilder b;
    b.triangle({{"mode", 0}});
    b.triangle({{"mode", 3}});
    b.triangle();
    Scene scene = b.load();
    EXPECT_EQ(scene.indices.size(), 3u);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("2 primitives of points or lines are left out")));
}

TEST(Mesh, MissingNormalsAreFlat) {
    // Two triangles that share an edge and stand at right angles: no normal may be shared.
    GltfBuilder b;
    int positions = b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    int indices = b.accessor_of<uint8_t>({0, 1, 2, 0, 3, 1}, u8, "SCALAR", 1);
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    Scene scene = b.load();
    ASSERT_EQ(scene.indices.size(), 6u);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_EQ(scene.vertices[scene.indices[i]].normal, glm::vec3(0, 0, 1));
    for (size_t i = 3; i < 6; ++i)
        EXPECT_EQ(scene.vertices[scene.indices[i]].normal, glm::vec3(0, 1, 0));
}

TEST(Mesh, BadNormalsAreReplaced) {
    GltfBuilder b;
    float nan = std::numeric_limits<float>::quiet_NaN();
    int normals = b.vec3s({0, 0, 2, 0, 0, 0, nan, 0, 0});
    b.triangle({{"attributes", {{"NORMAL", normals}}}});
    Scene scene = b.load();
    for (const Vertex& v : scene.vertices)
        EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("2 normals")));
}

json textured_material(GltfBuilder& b) {
    b.add("images", {{"uri", "data:image/"
                             "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+"
                             "M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}});
    b.add("textures", {{"source", 0}});
    return {{"normalTexture", {{"index", 0}}}};
}

/// A quad in z = 0 whose texture coordinates are mirrored on its right half: u = |x|.
Scene mirrored_quad(const json& transform = json()) {
    GltfBuilder b;
    json material = textured_material(b);
    if (!transform.is_null()) material["normalTexture"]["extensions"]["KHR_texture_transform"] = transform;
    b.add("materials", material);
    json attributes{{"POSITION", b.vec3s({-1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0})},
                    {"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})},
                    {"TEXCOORD_0", b.vec2s({1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 1})}};
    int indices = b.accessor_of<uint8_t>({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}, u8, "SCALAR", 1);
    b.node({{"mesh", b.mesh({{"attributes", attributes}, {"indices", indices}, {"material", 0}})}});
    return b.load();
}

TEST(Mesh, TangentsFollowUOnBothSidesOfAMirror) {
    Scene scene = mirrored_quad();
    ASSERT_EQ(scene.indices.size(), 12u);
    EXPECT_EQ(scene.vertices.size(), 8u); // the two vertices on the seam are split
    for (size_t i = 0; i < 12; ++i) {
        const Vertex& v = scene.vertices[scene.indices[i]];
        bool right = i >= 6;
        EXPECT_NEAR(v.tangent.x, right ? 1 : -1, 1e-6) << i;
        // bitangent = cross(n, t)·w points along +v, which is +y on both sides.
        glm::vec3 bitangent = glm::cross(v.normal, glm::vec3(v.tangent)) * v.tangent.w;
        EXPECT_NEAR(bitangent.y, 1, 1e-6) << i;
    }
}

TEST(Mesh, TangentsFollowTheTransformedCoordinates) {
    // Turned by 90°: u' = v, v' = −u, so u' grows along +y.
    Scene scene = mirrored_quad({{"rotation", 1.57079632679}});
    for (size_t i = 0; i < 12; ++i) {
        const Vertex& v = scene.vertices[scene.indices[i]];
        EXPECT_NEAR(v.tangent.y, 1, 1e-5) << i;
        glm::vec3 bitangent = glm::cross(v.normal, glm::vec3(v.tangent)) * v.tangent.w;
        EXPECT_NEAR(bitangent.x, i < 6 ? 1 : -1, 1e-5) << i; // v' = −u, and u = |x|
    }
}

TEST(Mesh, AuthoredTangentsAreKept) {
    GltfBuilder b;
    b.add("materials", textured_material(b));
    json attributes{{"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                    {"TANGENT", b.vec4s({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1})},
                    {"TEXCOORD_0", b.vec2s({0, 0, 1, 0, 0, 1})}};
    b.triangle({{"attributes", attributes}, {"material", 0}});
    for (const Vertex& v : b.load().vertices)
        EXPECT_EQ(v.tangent, glm::vec4(0, 1, 0, -1));
}

TEST(Mesh, TextureTransformMatchesItsSpecification) {
    // The extension's own example: a quarter of the picture, offset (0, 1), turned by 90°, halved.
    TextureSlot slot;
    slot.offset = {0, 1};
    slot.rotation = 1.57079632679f;
    slot.scale = {0.5f, 0.5f};
    auto at = [&](float u, float v) {
        Vertex vertex;
        vertex.u0 = u;
        vertex.v0 = v;
        return slot_uv(vertex, slot);
    };
    EXPECT_NEAR(glm::distance(at(0, 0), glm::vec2(0, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(at(1, 0), glm::vec2(0, 0.5f)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(at(0, 1), glm::vec2(0.5f, 1)), 0, 1e-6);
}

TEST(Mesh, PrimitivesOfTheSameAccessorsShareVertices) {
    GltfBuilder b;
    json attributes{{"POSITION", b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})},
                    {"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}};
    int first = b.accessor_of<uint8_t>({0, 1, 2}, u8, "SCALAR", 1);
    int second = b.accessor_of<uint8_t>({1, 3, 2}, u8, "SCALAR", 1);
    for (int indices : {first, second, first})
        b.node({{"mesh", b.mesh({{"attributes", attributes}, {"indices", indices}})}});
    Scene scene = b.load();
    EXPECT_EQ(scene.vertices.size(), 4u);
    EXPECT_EQ(scene.indices.size(), 6u);
    EXPECT_EQ(scene.meshes[2].primitives[0].first_index, scene.meshes[0].primitives[0].first_index);
}

TEST(Mesh, MissingPositionsAreLeftOut) {
    GltfBuilder b;
    b.node({{"mesh", b.mesh({{"attributes", {{"NORMAL", b.vec3s({0, 0, 1})}}}})}});
    Scene scene = b.load();
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    EXPECT_THAT(scene.notes, Contains(HasSubstr("without POSITION")));
}

} // namespace
} // namespace bounce::testing
