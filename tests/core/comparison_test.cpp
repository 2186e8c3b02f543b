// Files of named parts are paired, masked and told apart.

#include "core/comparison.h"
#include "core/error.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bounce;

namespace {

Image flat(float value, int channels = 3) {
    Image image(12, 8, channels);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

LayeredImage reference() {
    LayeredImage image;
    image.layers["out.direct"] = flat(2);
    image.layers["out.emitted"] = flat(1);
    image.layers["out.indirect_diffuse"] = flat(0.5f);
    image.layers["out.ambient_occlusion"] = flat(0.8f, 1);
    image.layers["gbuffer.normal"] = flat(0);
    image.layers["gbuffer.position"] = flat(0);
    image.layers["gbuffer.material"] = flat(3, 1);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 12; ++x) {
            image.layers["gbuffer.normal"].at(x, y)[x < 6 ? 1 : 2] = 1; // a crease down the middle
            image.layers["gbuffer.position"].at(x, y)[0] = 0.01f * float(x);
        }
    }
    image.metadata = R"({"camera_position":[0,5,5],"noise":{"out.direct":{"rms":0.3,"rms_off_edges":0.1}}})";
    return image;
}

} // namespace

TEST(Comparison, PairsPartsByName) {
    LayeredImage test = reference();
    test.layers.erase("out.emitted");
    test.layers["out.display"] = flat(0);
    test.layers["out.direct"] = flat(2.2f);
    const LayerComparison comparison = compare_layers(test, reference(), {});
    std::vector<std::string> names;
    for (const auto& part : comparison.parts)
        names.push_back(part.part);
    EXPECT_THAT(names, testing::ElementsAre("out.ambient_occlusion", "out.direct", "out.indirect_diffuse"));
    EXPECT_TRUE(comparison.edges_masked);
    EXPECT_EQ(comparison.mask.count(), 80u); // two columns of the twelve
    EXPECT_NEAR(comparison.parts[1].figures["bias"], 0.1, 1e-6);
    EXPECT_NEAR(comparison.parts[1].figures["reference_noise"], 0.05, 1e-6);
    EXPECT_NEAR(comparison.parts[1].figures["relative_rmse_denoised"], std::sqrt(0.01 - 0.0025), 1e-6);
    EXPECT_NEAR(comparison.parts[1].figures["own_noise"], 0.05, 1e-6);
    EXPECT_GT(comparison.parts[1].figures["flip"], 0);
    EXPECT_EQ(comparison.parts[2].figures["flip"], 0);
    EXPECT_NEAR(comparison.parts[2].figures["ssim"], 1, 1e-6);
}

TEST(Comparison, ComparesSumsOfParts) {
    LayeredImage test = reference();
    test.layers.erase("out.emitted");
    test.layers["out.indirect_diffuse"] = flat(1.5f);
    ComparisonOptions options;
    options.parts = {"out.emitted+out.indirect_diffuse"};
    const LayerComparison comparison = compare_layers(test, reference(), options);
    EXPECT_NEAR(comparison.parts[0].figures["relative_rmse"], 0, 1e-7);
}

TEST(Comparison, TellsSurfacesApart) {
    LayeredImage test = reference();
    for (int y = 0; y < 8; ++y) {
        for (int x = 6; x < 12; ++x)
            std::fill_n(test.layers["out.direct"].at(x, y), 3, 3.0f);
    }
    const LayerComparison comparison = compare_layers(test, reference(), {});
    const auto surfaces = compare_surfaces(test, reference(), "out.direct", comparison.mask);
    ASSERT_EQ(surfaces.size(), 2u);
    for (const auto& surface : surfaces) {
        EXPECT_EQ(surface.material, 3);
        EXPECT_NEAR(surface.figures["bias"], surface.axis == "+y" ? 0 : 0.5, 1e-6);
    }
}

TEST(Comparison, SaysWhatIsMissing) {
    LayeredImage other;
    other.layers["out.indirect"] = flat(1);
    ComparisonOptions options;
    EXPECT_THROW(compare_layers(other, reference(), options), Error);
    options.parts = {"out.indirect_difuse"};
    try {
        compare_layers(reference(), reference(), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'out.indirect_diffuse'"));
    }
    LayeredImage small = reference();
    small.layers["out.direct"] = Image(3, 3, 3);
    EXPECT_THROW(compare_layers(small, reference(), {}), Error);
    LayeredImage broken = reference();
    broken.layers["out.direct"].pixels[7] = std::nanf("");
    EXPECT_THROW(compare_layers(broken, reference(), {}), Error);
}

TEST(Comparison, ReadsPicturesOfAllKinds) {
    std::string pattern = (std::filesystem::temp_directory_path() / "bounce-compare-XXXXXX").string();
    const std::filesystem::path folder = mkdtemp(pattern.data());
    Image8 picture{2, 1, {128, 0, 255, 255, 0, 0, 0, 255}};
    write_png(folder / "a.png", picture);
    bool display = false;
    const LayeredImage read = read_picture(folder / "a.png", display);
    EXPECT_TRUE(display);
    EXPECT_NEAR(read.layers.at("").at(0, 0)[0], srgb_decode(128.0f / 255), 1e-6f);
    write_exr(folder / "a.exr", reference());
    EXPECT_EQ(read_picture(folder / "a.exr", display).layers.size(), 7u);
    EXPECT_FALSE(display);
    ComparisonOptions options;
    options.display_values = true;
    EXPECT_EQ(compare_layers(read, read, options).parts.size(), 1u);
    std::filesystem::remove_all(folder);
}

/// The reference covers the areas of its pixels: a picture of more pixels is compared by its means over these.
TEST(Comparison, APictureOfAMultipleSizeIsAveraged) {
    LayeredImage large;
    Image& direct = large.layers["out.direct"] = Image(36, 24, 3);
    Image& normal = large.layers["gbuffer.normal"] = Image(36, 24, 3);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 36; ++x) {
            direct.at(x, y)[0] = float(x / 3 + 12 * (y / 3)) + float(x % 3 + y % 3) - 2; // 0 on average
            normal.at(x, y)[0] = float(x + 36 * y);
        }
    }
    large.metadata = R"({"camera_position":[0,5,5],"noise":{"out.direct":{"rms":0.3}}})";
    int k = 0;
    LayeredImage small = averaged_to_size_of(reference(), large, &k);
    EXPECT_EQ(k, 3);
    ASSERT_EQ(small.layers["out.direct"].width, 12);
    ASSERT_EQ(small.layers["out.direct"].height, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 12; ++x) {
            EXPECT_NEAR(small.layers["out.direct"].at(x, y)[0], float(x + 12 * y), 1e-4);
            EXPECT_EQ(small.layers["gbuffer.normal"].at(x, y)[0], float(3 * x + 1 + 36 * (3 * y + 1)))
                << "a normal is no mean";
        }
    EXPECT_EQ(small.metadata.find("noise"), std::string::npos);
    EXPECT_NE(small.metadata.find("camera_position"), std::string::npos);
    large.layers["out.direct"] = Image(36, 16, 3); // no multiple of the same number both ways: left alone
    EXPECT_EQ(averaged_to_size_of(reference(), large, &k).layers["out.direct"].width, 36);
    EXPECT_EQ(k, 1);
}
