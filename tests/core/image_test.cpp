// Images survive a round trip through their files, and a write that fails leaves nothing behind.

#include "core/exr_file.h"
#include "core/image.h"
#include "support/errors.h"

#include <ImfChannelList.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace bounce;

namespace {

class ImageFiles : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "bounce-image-XXXXXX").string();
        folder = mkdtemp(pattern.data());
    }
    void TearDown() override { fs::remove_all(folder); }
    size_t count_files() const {
        return size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    fs::path folder;
};

Image gradient(int width, int height, int channels) {
    Image image(width, height, channels);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 0.37f * float(i) - 3.0f;
    return image;
}

} // namespace

TEST_F(ImageFiles, ExrKeepsLayersChannelsAndMetadata) {
    LayeredImage image;
    image.layers[""] = gradient(7, 5, 3);
    image.layers["out.direct"] = gradient(7, 5, 3);
    image.layers["out.ambient_occlusion"] = gradient(7, 5, 1);
    image.layers["gbuffer.uv"] = gradient(7, 5, 2);
    image.layers["gbuffer.albedo"] = gradient(7, 5, 4);
    image.layers["out.direct"].at(6, 4)[2] = std::numeric_limits<float>::infinity();
    image.metadata = R"({"shot":"cornell"})";
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(count_files(), 1u);

    LayeredImage read = read_exr(folder / "a.exr");
    EXPECT_EQ(read.metadata, image.metadata);
    ASSERT_EQ(read.layers.size(), image.layers.size());
    for (const auto& [name, layer] : image.layers) {
        ASSERT_TRUE(read.layers.count(name)) << name;
        EXPECT_EQ(read.layers[name].channels, layer.channels) << name;
        EXPECT_EQ(read.layers[name].width, 7);
        EXPECT_EQ(read.layers[name].pixels, layer.pixels) << name;
    }
}

/// As other programs read it: OpenEXR's own interface for plain pictures, which knows no layers.
static std::vector<float> plain_pixels(const fs::path& path, int channels) {
    Imf::RgbaInputFile file(path.c_str());
    const Imath::Box2i window = file.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    std::vector<Imf::Rgba> pixels(size_t(width) * size_t(height));
    file.setFrameBuffer(pixels.data() - window.min.x - window.min.y * width, 1, size_t(width));
    file.readPixels(window.min.y, window.max.y);
    std::vector<float> values;
    for (const Imf::Rgba& p : pixels) {
        const float all[4] = {p.r, p.g, p.b, p.a};
        values.insert(values.end(), all, all + channels);
    }
    return values;
}

static Image halves(int channels) { // exact in 16 bits, as that interface reads them
    Image image(6, 4, channels);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 0.25f * float(i) - 3.0f;
    return image;
}

TEST_F(ImageFiles, OtherProgramsSeeTheDefaultLayer) {
    LayeredImage image;
    image.layers["out.radiance"] = halves(3);
    image.layers["out.direct"] = gradient(6, 4, 3);
    write_exr(folder / "a.exr", image, "out.radiance");
    EXPECT_EQ(plain_pixels(folder / "a.exr", 3), image.layers["out.radiance"].pixels);
    // We read back what was written, each layer once and under its name.
    const LayeredImage read = read_exr(folder / "a.exr");
    ASSERT_EQ(read.layers.size(), 2u);
    for (const auto& [name, layer] : image.layers)
        EXPECT_EQ(read.layers.at(name).pixels, layer.pixels) << name;
}

TEST_F(ImageFiles, AFileOfOneResourceIsAPlainPicture) {
    for (int channels = 1; channels <= 4; ++channels) {
        LayeredImage image;
        image.layers["a.b"] = halves(channels);
        write_exr(folder / "a.exr", image, "a.b");
        Imf::InputFile file((folder / "a.exr").c_str());
        std::string names;
        for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it)
            names += it.name();
        EXPECT_EQ(names, (std::array{"Y", "GR", "BGR", "ABGR"})[size_t(channels - 1)]); // in the alphabet's order
        if (channels >= 3) {
            EXPECT_EQ(plain_pixels(folder / "a.exr", channels), image.layers["a.b"].pixels);
        }
        const LayeredImage read = read_exr(folder / "a.exr");
        ASSERT_EQ(read.layers.size(), 1u);
        EXPECT_EQ(read.layers.at("a.b").pixels, image.layers["a.b"].pixels);
    }
}

TEST_F(ImageFiles, TheSameExrIsTheSameBytes) {
    LayeredImage image;
    image.layers["out.radiance"] = gradient(64, 48, 3);
    write_exr(folder / "a.exr", image);
    write_exr(folder / "b.exr", image);
    EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST_F(ImageFiles, ExrErrorsNameTheFileAndTheProblem) {
    LayeredImage image;
    EXPECT_THAT(error_of([&] { write_exr(folder / "x.exr", image); }), testing::HasSubstr("no layers"));
    image.layers["a"] = Image(4, 4, 3);
    image.layers["b"] = Image(4, 5, 3);
    EXPECT_THAT(error_of([&] { write_exr(folder / "x.exr", image); }), testing::HasSubstr("'b' differs in size"));
    image.layers["b"] = Image(4, 4, 5);
    EXPECT_THAT(error_of([&] { write_exr(folder / "x.exr", image); }), testing::HasSubstr("1 to 4 channels"));
    image.layers.erase("b");
    EXPECT_THAT(error_of([&] { write_exr(folder / "x.exr", image, "c"); }), testing::HasSubstr("no layer 'c'"));
    EXPECT_EQ(count_files(), 0u);
    EXPECT_THAT(error_of([&] { read_exr(folder / "none.exr"); }),
                testing::AllOf(testing::HasSubstr("none.exr"), testing::HasSubstr("No such file")));
}

TEST_F(ImageFiles, DamagedExrIsAnError) {
    LayeredImage image;
    image.layers["out.direct"] = gradient(33, 21, 3);
    image.metadata = "{}";
    write_exr(folder / "a.exr", image);
    const std::string bytes = read_file(folder / "a.exr");
    auto write = [&](const std::string& text) { std::ofstream(folder / "b.exr", std::ios::binary) << text; };
    for (size_t length = 0; length < bytes.size(); length += 1 + length / 7) {
        write(bytes.substr(0, length));
        EXPECT_THAT(error_of([&] { read_exr(folder / "b.exr"); }), testing::HasSubstr("b.exr")) << length;
    }
    write("a text, no image");
    EXPECT_THAT(error_of([&] { read_exr(folder / "b.exr"); }), testing::HasSubstr("b.exr"));
    // A flipped byte may go unnoticed in a value, but must never do worse than an Error.
    for (size_t at = 8; at < bytes.size(); at += at < 500 ? 3 : 41) {
        std::string changed = bytes;
        changed[at] = char(changed[at] ^ 0x55);
        write(changed);
        (void)error_of([&] { read_exr(folder / "b.exr"); });
    }
}

TEST_F(ImageFiles, PngRoundTrip) {
    Image8 image{3, 2, {}};
    for (int i = 0; i < 24; ++i)
        image.rgba.push_back(uint8_t(i * 10));
    write_png(folder / "a.png", image);
    Image8 read = read_image8(folder / "a.png");
    EXPECT_EQ(read.width, 3);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.rgba, image.rgba);
    std::string bytes = read_file(folder / "a.png");
    Image8 decoded = decode_image8(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "embedded");
    EXPECT_EQ(decoded.rgba, image.rgba);
    EXPECT_THAT(error_of([&] { decode_image8(reinterpret_cast<const uint8_t*>("nonsense"), 8, "texture 4"); }),
                testing::HasSubstr("texture 4"));
    EXPECT_THAT(error_of([&] { read_hdr(folder / "a.png"); }), testing::HasSubstr("not a Radiance"));
}

TEST_F(ImageFiles, HdrIsReadLinear) {
    // One flat scanline of two pixels: (1, 0.5, 0.25) as mantissas 128, 64, 32 with exponent 129; then twice that.
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    text += std::string("\x80\x40\x20\x81\x80\x40\x20\x82", 8);
    write_file_atomically(folder / "a.hdr", text);
    Image image = read_hdr(folder / "a.hdr");
    ASSERT_EQ(image.width, 2);
    EXPECT_THAT(image.pixels, testing::ElementsAre(1.0f, 0.5f, 0.25f, 2.0f, 1.0f, 0.5f));
}

TEST_F(ImageFiles, FullDeviceIsAnError) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    LayeredImage image;
    image.layers["out.direct"] = gradient(8, 8, 3);
    EXPECT_THAT(error_of([&] { write_exr("/dev/full", image); }), testing::HasSubstr("No space left"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(ImageFiles, AFailedWriteKeepsTheOldFileAndLeavesNoOther) {
    write_file_atomically(folder / "a.txt", "old");
    // A limit on the file size makes write() fail half way, as a full disk does.
    struct rlimit before;
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = before;
    small.rlim_cur = 4096;
    auto old_handler = signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string message = error_of([&] { write_file_atomically(folder / "a.txt", std::string(100000, 'x')); });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, old_handler);
    EXPECT_THAT(message, testing::HasSubstr("File too large"));
    EXPECT_EQ(read_file(folder / "a.txt"), "old");
    EXPECT_EQ(count_files(), 1u);
}

TEST_F(ImageFiles, BadTargetsAreNamed) {
    EXPECT_THAT(error_of([&] { write_file_atomically(folder / "none" / "a.txt", "x"); }),
                testing::HasSubstr("there is no folder"));
    EXPECT_THAT(error_of([&] { write_file_atomically(folder, "x"); }), testing::HasSubstr("it is a folder"));
    EXPECT_THAT(error_of([&] { read_file(folder); }), testing::HasSubstr(folder.string()));
}

TEST_F(ImageFiles, ALinkIsFollowed) {
    write_file_atomically(folder / "real.txt", "old");
    fs::create_symlink(folder / "real.txt", folder / "link.txt");
    write_file_atomically(folder / "link.txt", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
    EXPECT_EQ(read_file(folder / "real.txt"), "new");
}

TEST(Srgb, EncodesAndDecodes) {
    EXPECT_EQ(srgb_encode(0.0f), 0.0f);
    EXPECT_EQ(srgb_encode(1.0f), 1.0f);
    EXPECT_EQ(srgb_encode(7.0f), 1.0f);
    EXPECT_EQ(srgb_encode(std::numeric_limits<float>::quiet_NaN()), 0.0f);
    EXPECT_NEAR(srgb_encode(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(srgb_decode(0.5f), 0.214041f, 1e-5f);
    for (int i = 0; i < 256; ++i)
        EXPECT_NEAR(srgb_encode(srgb_decode(float(i) / 255)) * 255, float(i), 1e-3f);
}
