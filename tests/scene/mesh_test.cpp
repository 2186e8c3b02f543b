// Primitives: strips and fans, normals and tangents made, sharing, and what is left out.

#include "gltf_builder.h"
#include "scene/shading_frame.h"

#include <functional>
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

/// Two quads of one vertex buffer without normals, a floor and a wall, as primitives of their own.
Scene floor_and_wall(bool shared, float normal) {
    GltfBuilder b;
    std::vector<float> floor{0, 0, 0, 0, 0, 2, 2, 0, 2, 2, 0, 0}, wall{0, 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2};
    auto attributes = [&](const std::vector<float>& positions) {
        return json{{"POSITION", b.vec3s(positions)},
                    {"NORMAL", b.vec3s(std::vector<float>(positions.size(), normal))}};
    };
    json primitives = json::array();
    std::vector<float> both = floor;
    both.insert(both.end(), wall.begin(), wall.end());
    json of_both = attributes(both);
    for (uint8_t first : {0, 4}) {
        uint8_t base = shared ? first : 0;
        std::vector<uint8_t> order{base, uint8_t(base + 1), uint8_t(base + 2),
                                   base, uint8_t(base + 2), uint8_t(base + 3)};
        int indices = b.accessor_of<uint8_t>(order, u8, "SCALAR", 1);
        primitives.push_back(
            {{"attributes", shared ? of_both : attributes(first ? wall : floor)}, {"indices", indices}});
    }
    b.node({{"mesh", b.add("meshes", {{"primitives", primitives}})}});
    return b.load();
}

TEST(Mesh, BadNormalsOfSharedVerticesAreMadeForEachPrimitive) {
    for (float bad : {0.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (bool shared : {false, true}) {
            Scene scene = floor_and_wall(shared, bad);
            ASSERT_EQ(scene.indices.size(), 12u);
            for (size_t i = 0; i < 12; ++i) {
                const Vertex& v = scene.vertices[scene.indices[i]];
                EXPECT_EQ(v.normal, i < 6 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)) << shared << " " << bad;
                EXPECT_NEAR(glm::dot(v.normal, glm::vec3(v.tangent)), 0, 1e-6);
            }
            EXPECT_THAT(scene.notes, Contains(HasSubstr("8 normals")));
        }
}

TEST(Mesh, GoodNormalsBesideBadOnesAreKept) {
    GltfBuilder b;
    json attributes{{"POSITION", b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})},
                    {"NORMAL", b.vec3s({0, 0, 0, 0, 0, 1e-20f, 0, 0, 1e25f, 0, 1, 0})}};
    int front = b.accessor_of<uint8_t>({0, 1, 2}, u8, "SCALAR", 1);
    int below = b.accessor_of<uint8_t>({0, 3, 1}, u8, "SCALAR", 1);
    json primitives{{{"attributes", attributes}, {"indices", front}}, {{"attributes", attributes}, {"indices", below}}};
    b.node({{"mesh", b.add("meshes", {{"primitives", primitives}})}});
    Scene scene = b.load();
    auto normal = [&](size_t i) { return scene.vertices[scene.indices[i]].normal; };
    for (size_t i : {0, 1, 2, 5})
        EXPECT_EQ(normal(i), glm::vec3(0, 0, 1)) << i; // however short or long
    EXPECT_EQ(normal(3), glm::vec3(0, 1, 0));          // of the other triangle alone
    EXPECT_EQ(normal(4), glm::vec3(0, 1, 0));
}

glm::vec3 bitangent(const Vertex& v) {
    return glm::cross(v.normal, glm::vec3(v.tangent)) * v.tangent.w;
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
        // bitangent = cross(n, t)·w points where a map's green does: up in the picture, against v, which is −y on both
        // sides.
        EXPECT_NEAR(bitangent(v).y, -1, 1e-6) << i;
    }
}

TEST(Mesh, TangentsFollowTheTransformedCoordinates) {
    // Turned by 90°: u' = v, v' = −u, so u' grows along +y.
    Scene scene = mirrored_quad({{"rotation", 1.57079632679}});
    for (size_t i = 0; i < 12; ++i) {
        const Vertex& v = scene.vertices[scene.indices[i]];
        EXPECT_NEAR(v.tangent.y, 1, 1e-5) << i;
        EXPECT_NEAR(bitangent(v).x, i < 6 ? -1 : 1, 1e-5) << i; // −v' = u, and u = |x|
    }
}

/// A quad that faces +z, its picture upright: u to the right, v down. `more` attributes.
Scene upright_quad(const std::function<void(GltfBuilder&, json&)>& change) {
    GltfBuilder b;
    b.add("materials", textured_material(b));
    json attributes{{"POSITION", b.vec3s({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0})},
                    {"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})},
                    {"TEXCOORD_0", b.vec2s({0, 1, 1, 1, 1, 0, 0, 0})}};
    change(b, attributes);
    int indices = b.accessor_of<uint8_t>({0, 1, 2, 0, 2, 3}, u8, "SCALAR", 1);
    b.node({{"mesh", b.mesh({{"attributes", attributes}, {"indices", indices}, {"material", 0}})}});
    return b.load();
}

TEST(Mesh, GeneratedTangentsOfAnUprightPictureAreRightHanded) {
    for (const Vertex& v : upright_quad([](GltfBuilder&, json&) {}).vertices) {
        EXPECT_NEAR(glm::distance(v.tangent, glm::vec4(1, 0, 0, 1)), 0, 1e-6);
        EXPECT_NEAR(bitangent(v).y, 1, 1e-6);
    }
}

TEST(Mesh, GeneratedTangentsOfAMirroredPictureAreLeftHanded) {
    Scene scene = upright_quad([](GltfBuilder& b, json& a) { a["TEXCOORD_0"] = b.vec2s({1, 1, 0, 1, 0, 0, 1, 0}); });
    for (const Vertex& v : scene.vertices) {
        EXPECT_NEAR(glm::distance(v.tangent, glm::vec4(-1, 0, 0, -1)), 0, 1e-6);
        EXPECT_NEAR(bitangent(v).y, 1, 1e-6); // up all the same
    }
}

TEST(Mesh, TangentsFollowTinyTextureCoordinates) {
    std::vector<float> uv{0, 1, 1, 1, 1, 0, 0, 0};
    for (float& x : uv)
        x *= 1e-25f;
    Scene scene = upright_quad([&](GltfBuilder& b, json& a) { a["TEXCOORD_0"] = b.vec2s(uv); });
    for (const Vertex& v : scene.vertices)
        EXPECT_NEAR(glm::distance(v.tangent, glm::vec4(1, 0, 0, 1)), 0, 1e-6);
}

TEST(Mesh, DegenerateTextureCoordinatesGiveAnyFrame) {
    for (const std::vector<float>& uv : {std::vector<float>(8, 0.25f), {0, 0, 1, 1, 1, 1, 0, 0}}) {
        Scene scene = upright_quad([&](GltfBuilder& b, json& a) { a["TEXCOORD_0"] = b.vec2s(uv); });
        for (const Vertex& v : scene.vertices) {
            EXPECT_NEAR(glm::length(glm::vec3(v.tangent)), 1, 1e-6);
            EXPECT_EQ(v.tangent.z, 0);
            EXPECT_EQ(std::abs(v.tangent.w), 1);
        }
    }
}

TEST(Mesh, TangentsThatLackSomethingAreMadeFromTheCoordinates) {
    float nan = std::numeric_limits<float>::quiet_NaN();
    // One vertex each: no handedness, none a number, no direction, no number; the rest is authored and kept.
    for (const glm::vec4& bad : {glm::vec4(0, 1, 0, 0), glm::vec4(0, 1, 0, nan), glm::vec4(0, 0, 0, -1),
                                 glm::vec4(nan, 0, 0, 1), glm::vec4(0, 0, 0, 0)}) {
        Scene scene = upright_quad([&](GltfBuilder& b, json& a) {
            std::vector<float> tangents{0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, bad.x, bad.y, bad.z, bad.w};
            a["TANGENT"] = b.vec4s(tangents);
        });
        ASSERT_EQ(scene.vertices.size(), 4u);
        for (size_t i = 0; i < 3; ++i)
            EXPECT_EQ(scene.vertices[i].tangent, glm::vec4(0, -1, 0, -1));
        bool kept = bad.y == 1; // a good direction stays, and gets the coordinates' handedness
        EXPECT_NEAR(glm::distance(scene.vertices[3].tangent, kept ? glm::vec4(0, 1, 0, 1) : glm::vec4(1, 0, 0, 1)), 0,
                    1e-6);
        EXPECT_THAT(scene.notes, Contains(HasSubstr("1 tangents")));
    }
}

TEST(Mesh, TangentsAreSmoothOverVerticesThatAreAlike) {
    // A strip bent at x = 0 with a smooth normal there, once with shared vertices and once without indices.
    std::vector<float> p[6] = {{-1, 0, -1}, {0, 0, 0}, {1, 0, -1}, {-1, 1, -1}, {0, 1, 0}, {1, 1, -1}};
    float s = std::sqrt(0.5f);
    std::vector<float> n[3] = {{-s, 0, s}, {0, 0, 1}, {s, 0, s}};
    std::vector<float> uv[6] = {{0, 1}, {0.5f, 1}, {1, 1}, {0, 0}, {0.5f, 0}, {1, 0}};
    std::vector<uint8_t> order{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    auto build = [&](bool indexed) {
        GltfBuilder b;
        b.add("materials", textured_material(b));
        std::vector<float> positions, normals, coordinates;
        for (size_t k = 0; k < (indexed ? 6u : 12u); ++k) {
            size_t i = indexed ? k : order[k];
            positions.insert(positions.end(), p[i].begin(), p[i].end());
            normals.insert(normals.end(), n[i % 3].begin(), n[i % 3].end());
            coordinates.insert(coordinates.end(), uv[i].begin(), uv[i].end());
        }
        json primitive{
            {"attributes",
             {{"POSITION", b.vec3s(positions)}, {"NORMAL", b.vec3s(normals)}, {"TEXCOORD_0", b.vec2s(coordinates)}}},
            {"material", 0}};
        if (indexed) primitive["indices"] = b.accessor_of<uint8_t>(order, u8, "SCALAR", 1);
        b.node({{"mesh", b.mesh(primitive)}});
        return b.load();
    };
    Scene indexed = build(true), loose = build(false);
    for (size_t i = 0; i < 12; ++i) {
        const Vertex &a = indexed.vertices[indexed.indices[i]], &b = loose.vertices[loose.indices[i]];
        EXPECT_NEAR(glm::distance(a.tangent, b.tangent), 0, 1e-6) << i;
    }
    EXPECT_NEAR(glm::distance(indexed.vertices[1].tangent, glm::vec4(1, 0, 0, 1)), 0, 1e-6); // over the bend
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
