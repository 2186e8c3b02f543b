// Files that lie: every lie is one clear message, and none is a crash, a hang or a huge allocation.

#include "gltf_builder.h"

#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

GltfBuilder triangle() {
    GltfBuilder b;
    b.triangle();
    return b;
}

/// The message when the triangle's document is changed at a JSON pointer.
std::string error_with(const char* pointer, const json& value) {
    GltfBuilder b = triangle();
    json root = json::parse(b.text());
    root[json::json_pointer(pointer)] = value;
    return load_error(root.dump());
}

TEST(Damaged, IndicesThatPointNowhere) {
    EXPECT_THAT(error_with("/nodes/0/mesh", 5), HasSubstr("nodes[0].mesh is 5, but there is 1 of meshes"));
    EXPECT_THAT(error_with("/accessors/0/bufferView", 9), HasSubstr("accessors[0].bufferView is 9"));
    EXPECT_THAT(error_with("/bufferViews/0/buffer", 1), HasSubstr("bufferViews[0].buffer is 1"));
    EXPECT_THAT(error_with("/meshes/0/primitives/0/material", 0), HasSubstr("there are 0 of materials"));
    EXPECT_THAT(error_with("/meshes/0/primitives/0/attributes/POSITION", 3), HasSubstr("attributes.POSITION is 3"));
    EXPECT_THAT(error_with("/scene", 0), HasSubstr("there are 0 of scenes"));
}

TEST(Damaged, WrongTypes) {
    EXPECT_THAT(error_with("/nodes", "many"), HasSubstr("nodes must be an array of objects, but is the text 'many'"));
    EXPECT_THAT(error_with("/nodes/0/mesh", -1), HasSubstr("must be an index, but is -1"));
    EXPECT_THAT(error_with("/nodes/0/mesh", 0.5), HasSubstr("must be an index, but is 0.5"));
    EXPECT_THAT(error_with("/nodes/0/translation", json::array({1, 2})), HasSubstr("an array of 3 numbers"));
    EXPECT_THAT(error_with("/nodes/0/scale", json::array({1, "x", 2})), HasSubstr("an array of 3 numbers"));
    EXPECT_THAT(error_with("/nodes/0/translation", json::array({1e300, 0, 0})), HasSubstr("an array of 3 numbers"));
    EXPECT_THAT(error_with("/accessors/0/type", "VEC7"), HasSubstr("VEC7"));
    EXPECT_THAT(error_with("/accessors/0/componentType", 5130), HasSubstr("componentType 5130"));
    EXPECT_THAT(error_with("/meshes/0/primitives/0/mode", 9), HasSubstr("mode is 9"));
    EXPECT_THAT(error_with("/asset", json::object()), HasSubstr("asset.version is missing"));
    EXPECT_THAT(error_with("/asset/version", "1.0"), HasSubstr("only glTF 2.x"));
    EXPECT_THAT(error_with("/asset/minVersion", "2.1"), HasSubstr("minVersion"));
    EXPECT_THAT(error_with("/accessors/0/type", "VEC2"), HasSubstr("POSITION (accessors[0]) must have 3 components"));
}

TEST(Damaged, WholeNumbersMayBeWrittenAsFloats) {
    GltfBuilder b = triangle();
    json root = json::parse(b.text());
    root["nodes"][0]["mesh"] = 0.0;
    root["accessors"][0]["count"] = 3.0;
    TempFolder folder;
    EXPECT_EQ(load_gltf(folder.write("a.gltf", root.dump())).indices.size(), 3u);
}

TEST(Damaged, AccessorsThatReachOutside) {
    EXPECT_THAT(error_with("/accessors/0/count", 4), HasSubstr("accessors[0] reaches outside its view"));
    EXPECT_THAT(error_with("/accessors/0/count", 4000000000u), HasSubstr("reaches outside"));
    EXPECT_THAT(error_with("/accessors/0/count", uint64_t(1) << 62), HasSubstr("reaches outside"));
    EXPECT_THAT(error_with("/accessors/0/byteOffset", 4), HasSubstr("reaches outside"));
    EXPECT_THAT(error_with("/accessors/0/byteOffset", ~uint64_t(0)), HasSubstr("reaches outside"));
    EXPECT_THAT(error_with("/bufferViews/0/byteOffset", ~uint64_t(0) - 8), HasSubstr("bufferViews[0] reaches outside"));
    EXPECT_THAT(error_with("/bufferViews/0/byteLength", 37), HasSubstr("bufferViews[0] reaches outside"));
    EXPECT_THAT(error_with("/bufferViews/0/byteStride", 4), HasSubstr("less than the 12 bytes"));
    EXPECT_THAT(error_with("/bufferViews/0/byteStride", uint64_t(1) << 63), HasSubstr("no multiple of 4 up to 252"));
    EXPECT_THAT(error_with("/bufferViews/0/byteStride", 16), HasSubstr("reaches outside"));
    EXPECT_THAT(error_with("/buffers/0/byteLength", 37), HasSubstr("there are 36 bytes"));
    EXPECT_THAT(error_with("/buffers/0/byteLength", uint64_t(1) << 60), HasSubstr("there are 36 bytes"));
}

TEST(Damaged, HugeCountsWithNothingBehindThem) {
    GltfBuilder b;
    int positions = b.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3000000000u}});
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("zeros are refused"));
}

TEST(Damaged, SmallFilesThatUnfoldToMuch) {
    // A mesh of many primitives drawn by many nodes: 2,100² is more than four million.
    GltfBuilder b = triangle();
    json primitive = b.root["meshes"][0]["primitives"][0];
    for (int i = 1; i < 2100; ++i)
        b.root["meshes"][0]["primitives"].push_back(primitive);
    for (int i = 1; i < 2100; ++i)
        b.node({{"mesh", 0}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("the nodes draw more than"));
}

TEST(Damaged, IndexOutOfRange) {
    GltfBuilder b;
    b.triangle({{"indices", b.accessor_of<uint16_t>({0, 1, 3}, u16, "SCALAR", 1)}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("index 2 is 3, but there are 3 vertices"));
}

TEST(Damaged, PositionsThatAreNotFinite) {
    GltfBuilder b;
    float inf = std::numeric_limits<float>::infinity();
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3s({0, 0, 0, inf, 0, 0, 0, 1, 0})}}}})}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("POSITION: element 1 is not finite"));
}

TEST(Damaged, AttributesOfUnequalLength) {
    GltfBuilder b;
    b.triangle({{"attributes", {{"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1})}}}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("NORMAL has 2 elements, but POSITION has 3"));
}

TEST(Damaged, Buffers) {
    EXPECT_THAT(error_with("/buffers/0/uri", "gone.bin"), HasSubstr("gone.bin"));
    EXPECT_THAT(error_with("/buffers/0/uri", "data:application/octet-stream;base64,@@@@"), HasSubstr("base64"));
    EXPECT_THAT(error_with("/buffers/0/uri", "data:application/octet-stream"), HasSubstr("comma"));
    EXPECT_THAT(error_with("/buffers/0/uri", "https://example.com/a.bin"), HasSubstr("it has a scheme"));
    EXPECT_THAT(error_with("/buffers/0", json{{"byteLength", 36}}), HasSubstr("no uri"));
    EXPECT_THAT(error_with("/buffers/0/uri", "."), HasSubstr("it is a folder; expected a regular file"));
}

TEST(Damaged, NodeGraphs) {
    auto graph = [](const json& nodes, const json& scenes = json::array()) {
        json root{{"asset", {{"version", "2.0"}}}, {"nodes", nodes}};
        if (!scenes.empty()) root["scenes"] = scenes;
        return load_error(root.dump());
    };
    EXPECT_THAT(graph({{{"children", {0}}}}), HasSubstr("nodes[0] is its own ancestor"));
    EXPECT_THAT(graph({{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}}), HasSubstr("(a cycle)"));
    EXPECT_THAT(graph({{{"children", {2}}}, {{"children", {2}}}, json::object()}),
                HasSubstr("nodes[2] is a child of nodes[0] and of nodes[1]"));
    EXPECT_THAT(graph({{{"children", {1}}}, json::object()}, {{{"nodes", {0, 1}}}}), HasSubstr("not a root"));
    EXPECT_THAT(graph({{{"children", {1, 1}}}, json::object()}), HasSubstr("may have one parent"));
}

TEST(Damaged, RequiredExtensionsAreNamed) {
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}) {
        GltfBuilder b = triangle();
        b.root["extensionsUsed"] = {name};
        b.root["extensionsRequired"] = {name};
        EXPECT_THAT(load_error(b.text()), AllOf(HasSubstr("requires"), HasSubstr(name)));
    }
}

TEST(Damaged, Animations) {
    auto with = [](std::vector<float> times, std::vector<float> values, const char* interpolation,
                   const char* path = "translation") {
        GltfBuilder b;
        b.triangle();
        json sampler{{"input", b.scalars(times)}, {"output", b.vec3s(values)}, {"interpolation", interpolation}};
        b.add("animations",
              {{"samplers", {sampler}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
        return load_error(b.text());
    };
    EXPECT_THAT(with({0, 1}, {0, 0, 0}, "LINEAR"), HasSubstr("2 key times want 2 values, but there are 1"));
    EXPECT_THAT(with({0, 1}, {0, 0, 0, 1, 1, 1}, "CUBICSPLINE"), HasSubstr("want 6 values"));
    EXPECT_THAT(with({2, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR"), HasSubstr("not before the last one"));
    EXPECT_THAT(with({-1, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR"), HasSubstr("not negative"));
    EXPECT_THAT(with({0, 1}, {0, 0, 0, 1, 1, 1}, "SMOOTH"), HasSubstr("SMOOTH"));
    EXPECT_THAT(with({0, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR", "rotation"), HasSubstr("must be VEC4"));
}

TEST(Damaged, SeveralErrorsAreToldTogether) {
    GltfBuilder b = triangle();
    b.root["nodes"][0]["mesh"] = 7;
    b.root["accessors"][0]["count"] = "three";
    EXPECT_THAT(load_error(b.text()),
                AllOf(HasSubstr("2 errors"), HasSubstr("nodes[0].mesh"), HasSubstr("accessors[0].count")));
}

TEST(Damaged, DeeplyNestedJson) {
    std::string deep(200000, '[');
    EXPECT_THAT(load_error("{\"extras\": " + deep), HasSubstr("levels deep"));
    std::string closed =
        "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(60, '[') + std::string(60, ']') + "}";
    TempFolder folder;
    EXPECT_NO_THROW(load_gltf(folder.write("a.gltf", closed)));
}

TEST(Damaged, NotJsonAtAll) {
    EXPECT_THAT(load_error("{\"asset\": "), HasSubstr("not valid JSON"));
    EXPECT_THAT(load_error(""), HasSubstr("empty"));
    EXPECT_THAT(load_error("[]"), HasSubstr("one JSON object"));
    EXPECT_THAT(load_error("{}"), HasSubstr("asset is missing"));
    EXPECT_THAT(load_error("no magic", "a.glb"), HasSubstr("does not begin with 'glTF'"));
    EXPECT_THROW(load_gltf("/nowhere/at/all.gltf"), Error);
    EXPECT_THROW(load_gltf(fs::temp_directory_path()), Error);
}

} // namespace
} // namespace bounce::testing
