// What scenes and shots name: relative paths to regular files, and no more pixels than a scene may have.

#include "core/limits.h"
#include "scene/find_scene.h"
#include "scene/gltf_builder.h"

#include <functional>
#include <gmock/gmock.h>
#include <sys/stat.h>

namespace bounce::testing {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

/// A triangle with its buffer in a file of that name.
json with_buffer(const std::string& uri) {
    GltfBuilder b;
    b.triangle();
    b.root["buffers"] = {{{"byteLength", b.data.size()}, {"uri", uri}}};
    return b.root;
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class References : public ::testing::Test {
  protected:
    References() {
        GltfBuilder b;
        b.triangle();
        folder.write("sets/buffers/a b.bin", b.data);
        folder.write("sets/scenes/here.bin", b.data);
    }
    std::string load(const json& root) {
        const fs::path file = folder.write("sets/scenes/x.gltf", root.dump());
        return message_of([&] { load_gltf(file); });
    }
    std::string shot(const json& root) {
        const fs::path file = folder.write("sets/shots/x.json", root.dump());
        return message_of([&] { load_shot(file.string()); });
    }
    TempFolder folder;
};

} // namespace

TEST_F(References, RelativePathsMayLeadUp) {
    EXPECT_EQ(load(with_buffer("here.bin")), "");
    EXPECT_EQ(load(with_buffer("./here.bin")), "");
    EXPECT_EQ(load(with_buffer("../buffers/a%20b.bin")), "");
    EXPECT_EQ(load(with_buffer("../buffers/a b.bin")), "");
}

TEST_F(References, NothingElseIsRead) {
    const std::string absolute = (folder.path() / "sets/scenes/here.bin").string();
    for (const std::string& uri : {absolute, "file://" + absolute, std::string("/dev/zero"), "%2F" + absolute.substr(1),
                                   std::string("http://localhost/here.bin"), std::string("here.bin%00.png")})
        EXPECT_THAT(load(with_buffer(uri)), AllOf(HasSubstr("buffers[0]: invalid uri"),
                                                  HasSubstr("expected a path relative to the scene's file")))
            << uri;
}

TEST_F(References, OnlyRegularFiles) {
    ASSERT_EQ(::mkfifo((folder.path() / "sets/scenes/pipe").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder.path() / "sets/scenes/zero");
    EXPECT_THAT(load(with_buffer("pipe")), HasSubstr("it is a pipe; expected a regular file"));
    EXPECT_THAT(load(with_buffer("zero")), HasSubstr("it is a device; expected a regular file"));
    EXPECT_THAT(load(with_buffer("../buffers")), HasSubstr("it is a folder; expected a regular file"));

    json image = with_buffer("here.bin");
    image["images"] = {{{"uri", "pipe"}}};
    image["textures"] = {{{"source", 0}}};
    image["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    EXPECT_THAT(load(image), HasSubstr("images[0] 'pipe': cannot read"));
    image["images"] = {{{"uri", "/dev/zero"}}};
    EXPECT_THAT(load(image), HasSubstr("invalid uri '/dev/zero'"));

    const std::string pipe = (folder.path() / "sets/scenes/pipe").string();
    EXPECT_THAT(message_of([&] { load_gltf(pipe); }), HasSubstr("it is a pipe"));
    EXPECT_THAT(message_of([&] { load_shot(pipe); }), HasSubstr("it is a pipe; expected a regular file"));
    fs::rename(pipe, pipe + ".gltf");
    EXPECT_THAT(message_of([&] { load_shot(pipe + ".gltf"); }), HasSubstr("it is a pipe"));
}

TEST_F(References, ShotsNameScenesAndMapsTheSameWay) {
    ASSERT_EQ(load(with_buffer("here.bin")), "");
    EXPECT_EQ(shot({{"scene", "../scenes/x.gltf"}}), "");
    const std::string absolute = (folder.path() / "sets/scenes/x.gltf").string();
    for (const std::string& name : {absolute, "file://" + absolute, std::string("http://localhost/x.gltf")}) {
        EXPECT_THAT(shot({{"scene", name}}), AllOf(HasSubstr("scene: invalid scene '" + name + "'"),
                                                   HasSubstr("expected a path relative to this file")));
        EXPECT_THAT(shot({{"scene", "../scenes/x.gltf"}, {"objects", {{{"scene", name}}}}}),
                    HasSubstr("objects[0].scene: invalid scene"));
        EXPECT_THAT(shot({{"scene", "../scenes/x.gltf"}, {"environment", name}}),
                    HasSubstr("environment: invalid file '" + name + "'"));
    }
    ASSERT_EQ(::mkfifo((folder.path() / "sets/shots/sky.hdr").c_str(), 0600), 0);
    EXPECT_THAT(shot({{"scene", "../scenes/x.gltf"}, {"environment", "sky.hdr"}}),
                HasSubstr("it is a pipe; expected a regular file"));
    // A person may name a file anywhere.
    EXPECT_EQ(find_given_scene(absolute), absolute);
    EXPECT_EQ(message_of([&] { load_shot(absolute); }), "");
}

namespace {

std::string png_header(uint32_t width, uint32_t height, size_t bytes) {
    auto number = [](uint32_t v) { return std::string{char(v >> 24), char(v >> 16), char(v >> 8), char(v)}; };
    std::string text = "\x89PNG\r\n\x1a\n" + number(13) + "IHDR" + number(width) + number(height) +
                       std::string("\x08\x06\0\0\0....", 9);
    return text + std::string(bytes, 'x');
}

/// A triangle whose materials show `count` images, each the same `bytes`.
json textured(const std::string& bytes, int images, int samplers = 1) {
    GltfBuilder b;
    for (int i = 0; i < images; ++i)
        b.add("images", {{"uri", "data:image/png;base64," + base64(bytes)}});
    for (int i = 0; i < images * samplers; ++i) {
        b.add("samplers", {{"wrapS", i % samplers ? 33071 : 10497}});
        b.add("textures", {{"source", i / samplers}, {"sampler", i}});
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    }
    b.triangle({{"material", 0}});
    return json::parse(b.text());
}

} // namespace

TEST_F(References, ImagesThatSayTooMuchAreRefusedBeforeTheyAreDecoded) {
    EXPECT_THAT(load(textured(png_header(16384, 16384, 100), 1)),
                AllOf(HasSubstr("images[0]: invalid size 16384x16384"), HasSubstr("do not fit in")));
    EXPECT_THAT(load(textured(png_header(30000, 10, 1000), 1)), HasSubstr("expected sides of 1 … 16384 pixels"));
    // Each could be; together they are more than a scene may have.
    EXPECT_THAT(load(textured(png_header(10000, 10000, 13000), 3)),
                AllOf(HasSubstr("3 textures: 300,000,000 pixels: expected at most 268,435,456 in all"),
                      HasSubstr("--max-texture")));
    EXPECT_THAT(load(textured(png_header(12000, 12000, 18000), 1, 2)), HasSubstr("2 textures: 288,000,000 pixels"))
        << "every texture has its own copy of an image";
    set_max_texture_pixels(15);
    const std::string message = load(textured(png_header(4, 4, 100), 1));
    set_max_texture_pixels(k_max_texture_pixels);
    EXPECT_THAT(message, HasSubstr("1 textures: 16 pixels: expected at most 15"));
}

TEST_F(References, ASmallFileDoesNotUnfoldToALargeScene) {
    GltfBuilder b;
    const int position = b.vec3s(std::vector<float>(3 * 3, 0.0f));
    const int bytes = b.view(std::string(60000, '\0'));
    json primitives = json::array();
    for (int i = 0; i < 60; ++i) // each index is a vertex of its own, because there are no normals
        primitives.push_back(
            {{"attributes", {{"POSITION", position}}}, {"indices", b.accessor(bytes, u8, "SCALAR", 59940, size_t(i))}});
    b.node({{"mesh", b.add("meshes", {{"primitives", primitives}})}});
    EXPECT_THAT(load(json::parse(b.text())), HasSubstr("expected at most 16 vertices for each byte of its buffers"));
}

} // namespace bounce::testing
