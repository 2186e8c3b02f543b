// Every way a glTF file may lay out its numbers, against the numbers that went in.

#include "gltf_builder.h"

#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::HasSubstr;

glm::vec4 colour_of(const Vertex& v) {
    auto unpack = [](uint32_t packed) { return glm::vec2(float(packed & 0xffff), float(packed >> 16)) / 65535.0f; };
    return {unpack(v.colour_rg), unpack(v.colour_ba)};
}

TEST(Accessor, PlainFloats) {
    GltfBuilder b;
    b.triangle();
    Scene scene = b.load();
    ASSERT_EQ(scene.vertices.size(), 3u);
    EXPECT_EQ(scene.indices, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(0, 1, 0));
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.meshes[0].primitives.size(), 1u);
    EXPECT_EQ(scene.materials[size_t(scene.meshes[0].primitives[0].material)].name, "default");
}

TEST(Accessor, IndicesOfEveryWidth) {
    auto check = [](auto values, Component component) {
        GltfBuilder b;
        int indices = b.accessor_of(values, component, "SCALAR", 1);
        int normals = b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
        int positions = b.vec3s({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0});
        b.node(
            {{"mesh", b.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}})}});
        Scene scene = b.load();
        ASSERT_EQ(scene.indices.size(), 3u);
        EXPECT_EQ(scene.vertices[scene.indices[0]].position, glm::vec3(0, 1, 0));
        EXPECT_EQ(scene.vertices[scene.indices[1]].position, glm::vec3(0, 0, 0));
        EXPECT_EQ(scene.vertices[scene.indices[2]].position, glm::vec3(1, 0, 0));
    };
    check(std::vector<uint8_t>{3, 1, 2}, u8);
    check(std::vector<uint16_t>{3, 1, 2}, u16);
    check(std::vector<uint32_t>{3, 1, 2}, u32);
}

TEST(Accessor, Interleaved) {
    // position, normal, texture coordinate of each vertex together, with 4 bytes between vertices.
    std::vector<float> all;
    for (float i = 0; i < 3; ++i)
        all.insert(all.end(), {i, i * i, 1, 0, 0, 1, 0.25f * i, 0.5f, -1});
    GltfBuilder b;
    int view = b.view(bytes_of(all), 36);
    json attributes{{"POSITION", b.accessor(view, f32, "VEC3", 3, 0)},
                    {"NORMAL", b.accessor(view, f32, "VEC3", 3, 12)},
                    {"TEXCOORD_0", b.accessor(view, f32, "VEC2", 3, 24)}};
    b.node({{"mesh", b.mesh({{"attributes", attributes}})}});
    Scene scene = b.load();
    ASSERT_EQ(scene.vertices.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.vertices[i].position, glm::vec3(float(i), float(i * i), 1));
        EXPECT_EQ(scene.vertices[i].normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(scene.vertices[i].u0, 0.25f * float(i));
        EXPECT_EQ(scene.vertices[i].v0, 0.5f);
    }
}

TEST(Accessor, LastElementMayEndBeforeItsStrideDoes) {
    // Three positions 16 bytes apart in 44 bytes: the last one ends with the view.
    std::vector<float> all{0, 0, 0, 7, 1, 0, 0, 7, 0, 1, 0};
    GltfBuilder b;
    int positions = b.accessor(b.view(bytes_of(all), 16), f32, "VEC3", 3);
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    EXPECT_EQ(b.load().vertices[2].position, glm::vec3(0, 1, 0));
}

TEST(Accessor, NormalisedIntegers) {
    GltfBuilder b;
    int bytes = b.accessor(b.view(bytes_of<uint8_t>({0, 255, 0, 0, 128, 51, 0, 0, 255, 0, 0, 0}), 4), u8, "VEC2", 3);
    b.root["accessors"][size_t(bytes)]["normalized"] = true;
    int shorts = b.accessor_of<uint16_t>({0, 65535, 32768, 13107, 65535, 0}, u16, "VEC2", 2);
    b.root["accessors"][size_t(shorts)]["normalized"] = true;
    b.triangle({{"attributes", {{"TEXCOORD_0", bytes}, {"TEXCOORD_1", shorts}}}});
    Scene scene = b.load();
    EXPECT_FLOAT_EQ(scene.vertices[0].v0, 1);
    EXPECT_FLOAT_EQ(scene.vertices[1].u0, 128.0f / 255);
    EXPECT_FLOAT_EQ(scene.vertices[1].v0, 0.2f);
    EXPECT_FLOAT_EQ(scene.vertices[0].v1, 1);
    EXPECT_FLOAT_EQ(scene.vertices[1].u1, 32768.0f / 65535);
    EXPECT_FLOAT_EQ(scene.vertices[1].v1, 0.2f);
}

TEST(Accessor, NormalisedSignedIntegersAreClampedAtMinusOne) {
    GltfBuilder b;
    b.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    int uv = b.accessor(b.view(bytes_of<int8_t>({-128, -127, 0, 0, 127, 0, 0, 0, 64, -64, 0, 0}), 4), i8, "VEC2", 3);
    b.root["accessors"][size_t(uv)]["normalized"] = true;
    b.triangle({{"attributes", {{"TEXCOORD_0", uv}}}});
    Scene scene = b.load();
    EXPECT_EQ(scene.vertices[0].u0, -1);
    EXPECT_EQ(scene.vertices[0].v0, -1);
    EXPECT_EQ(scene.vertices[1].u0, 1);
    EXPECT_FLOAT_EQ(scene.vertices[2].v0, -64.0f / 127);
}

TEST(Accessor, QuantisedPositions) {
    GltfBuilder b;
    b.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    b.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    int positions = b.accessor(b.view(bytes_of<int16_t>({0, 0, 0, 0, 100, 0, -7, 0, 0, 100, 0, 0}), 8), i16, "VEC3", 3);
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    EXPECT_EQ(b.load().vertices[1].position, glm::vec3(100, 0, -7));
}

TEST(Accessor, Sparse) {
    GltfBuilder b;
    int positions = b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.root["accessors"][size_t(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", b.view(bytes_of<uint16_t>({0, 2}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", b.view(bytes_of<float>({5, 6, 7, 8, 9, 10}))}}}};
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    Scene scene = b.load();
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(5, 6, 7));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(8, 9, 10));
}

TEST(Accessor, SparseOverZeros) {
    GltfBuilder b;
    int positions = b.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
    b.root["accessors"][size_t(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", b.view(bytes_of<uint8_t>({1, 2}))}, {"componentType", 5121}}},
        {"values", {{"bufferView", b.view(bytes_of<float>({1, 0, 0, 0, 1, 0}))}}}};
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    Scene scene = b.load();
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(0));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(0, 1, 0));
}

TEST(Accessor, SparseIndices) {
    GltfBuilder b;
    int indices = b.accessor_of<uint16_t>({0, 0, 0}, u16, "SCALAR", 1);
    b.root["accessors"][size_t(indices)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", b.view(bytes_of<uint8_t>({1, 2}))}, {"componentType", 5121}}},
        {"values", {{"bufferView", b.view(bytes_of<uint16_t>({2, 1}))}}}};
    b.triangle({{"indices", indices}});
    Scene scene = b.load();
    EXPECT_EQ(scene.vertices[scene.indices[1]].position, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.vertices[scene.indices[2]].position, glm::vec3(1, 0, 0));
}

TEST(Accessor, SparseOutOfRangeIsAnError) {
    GltfBuilder b;
    int positions = b.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.root["accessors"][size_t(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", b.view(bytes_of<uint16_t>({3, 0}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", b.view(bytes_of<float>({5, 6, 7}))}}}};
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("sparse replaces element 3, but there are 3"));
}

TEST(Accessor, VertexColours) {
    GltfBuilder b;
    int floats = b.vec3s({1, 0.5f, 0, 0, 1, 0.25f, 2, -1, 1});
    b.triangle({{"attributes", {{"COLOR_0", floats}}}});
    int bytes = b.accessor_of<uint8_t>({255, 0, 51, 102, 0, 255, 0, 255, 1, 2, 3, 4}, u8, "VEC4", 4);
    b.root["accessors"][size_t(bytes)]["normalized"] = true;
    b.triangle({{"attributes", {{"COLOR_0", bytes}}}});
    int shorts =
        b.accessor(b.view(bytes_of<uint16_t>({65535, 0, 13107, 0, 0, 0, 0, 0, 1, 2, 3, 0}), 8), u16, "VEC3", 3);
    b.triangle({{"attributes", {{"COLOR_0", shorts}}}});
    b.triangle();
    Scene scene = b.load();
    ASSERT_EQ(scene.vertices.size(), 12u);
    auto near = [](const glm::vec4& a, const glm::vec4& e) { return glm::length(a - e) < 2.0f / 65535; };
    EXPECT_TRUE(near(colour_of(scene.vertices[0]), {1, 0.5f, 0, 1}));
    EXPECT_TRUE(near(colour_of(scene.vertices[1]), {0, 1, 0.25f, 1}));
    EXPECT_TRUE(near(colour_of(scene.vertices[2]), {1, 0, 1, 1})); // clamped
    EXPECT_TRUE(near(colour_of(scene.vertices[3]), {1, 0, 0.2f, 0.4f}));
    EXPECT_TRUE(near(colour_of(scene.vertices[6]), {1, 0, 0.2f, 1}));
    EXPECT_EQ(colour_of(scene.vertices[9]), glm::vec4(1)); // white where absent
}

TEST(Accessor, ExternalAndBinaryBuffers) {
    GltfBuilder b;
    b.triangle();
    TempFolder folder;
    json external = b.root;
    // A file may be longer than byteLength, and its name percent-escaped.
    external["buffers"] = {{{"byteLength", b.data.size()}, {"uri", "sub/my%20data.bin"}}};
    folder.write("sub/my data.bin", b.data + "tail");
    EXPECT_EQ(load_gltf(folder.write("a.gltf", external.dump())).vertices[1].position, glm::vec3(1, 0, 0));

    json inside = b.root;
    inside["buffers"] = {{{"byteLength", b.data.size()}}};
    std::string text = inside.dump();
    while (text.size() % 4)
        text += ' ';
    auto u32_bytes = [](size_t v) { return bytes_of<uint32_t>({uint32_t(v)}); };
    std::string glb = "glTF" + u32_bytes(2) + u32_bytes(12 + 8 + text.size() + 8 + b.data.size()) +
                      u32_bytes(text.size()) + "JSON" + text + u32_bytes(b.data.size()) + std::string("BIN\0", 4) +
                      b.data;
    EXPECT_EQ(load_gltf(folder.write("a.glb", glb)).vertices[1].position, glm::vec3(1, 0, 0));
    // Truncated anywhere, it is an error and nothing worse.
    for (size_t length = 0; length < glb.size(); length += 7)
        EXPECT_THROW(load_gltf(folder.write("cut.glb", glb.substr(0, length))), Error) << length;
}

} // namespace
} // namespace bounce::testing
