// The texture view draws exactly the pixels that its settings ask for; single texels are read back exactly.
#include "app/hosts/headless.h"
#include "app/ui/texel.h"
#include "app/ui/texture_view.h"
#include "scene/scene.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace bounce {
namespace {

using testing::ElementsAre;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

class TextureViewTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { context = std::make_unique<HeadlessContext>(); }
    static void TearDownTestSuite() { context.reset(); }

    template <typename T>
    static GpuTexture make(GLenum format, glm::ivec3 size, const std::vector<T>& values,
                           TextureKind kind = TextureKind::texture_2d, int mips = 1, int mip = 0) {
        GpuTexture texture({kind, format, size, mips}, "test");
        upload(texture, values, mip);
        return texture;
    }
    template <typename T>
    static void upload(const GpuTexture& texture, const std::vector<T>& values, int mip = 0) {
        GLenum type = std::is_same_v<T, float> ? GL_FLOAT : std::is_same_v<T, int32_t> ? GL_INT : GL_UNSIGNED_INT;
        const Format& format = format_by_enum(texture.desc().format);
        glm::ivec3 s = mip_size(texture.desc(), mip);
        ASSERT_EQ(values.size(), size_t(s.x * s.y * s.z * format.channels));
        if (texture.desc().kind == TextureKind::texture_2d) {
            glTextureSubImage2D(texture.id(), mip, 0, 0, s.x, s.y, format.transfer, type, values.data());
        } else {
            glTextureSubImage3D(texture.id(), mip, 0, 0, 0, s.x, s.y, s.z, format.transfer, type, values.data());
        }
    }
    /// "rrggbb" of each texel of the picture. (Values of tests keep away from halves of 1/255, which drivers round as
    /// they like.)
    static std::vector<std::string> colours(TextureView& view, const GpuTexture& source,
                                            const ViewerSettings& settings) {
        uint64_t errors = high_severity_messages();
        std::vector<float> values = view.draw(source, settings).read();
        std::vector<std::string> out;
        for (size_t i = 0; i < values.size(); i += 4) {
            char text[8];
            auto byte = [&](size_t c) { return unsigned(std::lround(255 * values[i + c])); };
            std::snprintf(text, sizeof text, "%02x%02x%02x", byte(0), byte(1), byte(2));
            out.push_back(text);
            EXPECT_EQ(values[i + 3], 1);
        }
        EXPECT_EQ(high_severity_messages(), errors);
        return out;
    }
    static ViewerSettings plain() {
        ViewerSettings settings;
        settings.encode_srgb = false;
        return settings;
    }
    static inline std::unique_ptr<HeadlessContext> context;
    TextureView view;
};

TEST_F(TextureViewTest, ColoursClipToTheRange) {
    GpuTexture texture = make<float>(GL_RGBA32F, {2, 2, 1}, {0, 0.4f, 1, 1, -1, 2, 0.24f, 0, 1, 1, 1, 1, 0, 0, 0, 0});
    EXPECT_THAT(colours(view, texture, plain()), ElementsAre("0066ff", "00ff3d", "ffffff", "000000"));
    ViewerSettings wide = plain();
    wide.low = -1, wide.high = 4;
    EXPECT_THAT(colours(view, texture, wide), ElementsAre("334766", "00993f", "666666", "333333"));
    ViewerSettings turned = plain();
    turned.low = 1, turned.high = 0;
    EXPECT_THAT(colours(view, texture, turned), ElementsAre("ff9900", "ff00c2", "000000", "ffffff"));
}

TEST_F(TextureViewTest, EncodesForTheDisplay) {
    GpuTexture texture = make<float>(GL_RGBA32F, {1, 1, 1}, {0.5f, 0.002f, 0.2f, 1});
    ViewerSettings settings;
    EXPECT_THAT(colours(view, texture, settings), ElementsAre("bc077c")); // IEC 61966-2-1
}

TEST_F(TextureViewTest, ShowsOneChannelOrTheLength) {
    GpuTexture texture = make<float>(GL_RGBA32F, {1, 1, 1}, {0.4f, 0.2f, 0.4f, 1});
    std::vector<std::string> expected = {"663366", "666666", "333333", "666666", "ffffff", "999999"};
    for (int channel = 0; channel < 6; ++channel) {
        ViewerSettings settings = plain();
        settings.channel = channel;
        EXPECT_THAT(colours(view, texture, settings), ElementsAre(expected[size_t(channel)])) << channel;
    }
}

TEST_F(TextureViewTest, MarksWhatIsNotFinite) {
    GpuTexture texture = make<float>(
        GL_RGBA32F, {4, 1, 1}, {k_nan, 0, 0, 1, 0, k_infinity, 0, 1, 0, 0, -k_infinity, 1, k_infinity, k_nan, 0, 1});
    EXPECT_THAT(colours(view, texture, plain()), ElementsAre("ff00ff", "ffff00", "ffff00", "ff00ff"));
    ViewerSettings green = plain();
    green.channel = 2;
    EXPECT_THAT(colours(view, texture, green), ElementsAre("000000", "ffff00", "000000", "ff00ff"));
    ViewerSettings unmarked = plain();
    unmarked.mark_non_finite = false;
    EXPECT_THAT(colours(view, texture, unmarked), ElementsAre("000000", "00ff00", "000000", "ff0000"));
}

TEST_F(TextureViewTest, FindsTheRangeOfFiniteValues) {
    GpuTexture texture = make<float>(GL_R32F, {3, 2, 1}, {-4, k_nan, 0, 6, k_infinity, -2});
    ViewerSettings settings = plain();
    settings.automatic_range = true;
    EXPECT_THAT(colours(view, texture, settings),
                ElementsAre("000000", "ff00ff", "666666", "ffffff", "ffff00", "333333"));
    EXPECT_EQ(view.range(), glm::vec2(-4, 6));
    EXPECT_EQ(view.non_finite(), 2u);
    // Larger than one group, and not a multiple of its size.
    std::vector<float> many(37 * 21, 5.0f);
    many[400] = 11, many[776] = 3;
    view.draw(make<float>(GL_R32F, {37, 21, 1}, many), settings);
    EXPECT_EQ(view.range(), glm::vec2(3, 11));
    // Nothing finite: 0 … 1.
    EXPECT_THAT(colours(view, make<float>(GL_R32F, {1, 1, 1}, {k_nan}), settings), ElementsAre("ff00ff"));
    EXPECT_EQ(view.range(), glm::vec2(0, 1));
    // No extent: grey.
    EXPECT_THAT(colours(view, make<float>(GL_R32F, {1, 1, 1}, {7}), settings), ElementsAre("808080"));
}

TEST_F(TextureViewTest, LogarithmicRange) {
    GpuTexture texture = make<float>(GL_R32F, {5, 1, 1}, {0, 0.01f, 0.05f, 20, 100});
    ViewerSettings settings = plain();
    settings.logarithmic = true;
    settings.low = 0.01f, settings.high = 100;
    EXPECT_THAT(colours(view, texture, settings), ElementsAre("000000", "000000", "2d2d2d", "d2d2d2", "ffffff"));
    settings.low = 0; // six decades below the upper end
    EXPECT_THAT(colours(view, texture, settings), ElementsAre("000000", "555555", "737373", "e1e1e1", "ffffff"));
}

TEST_F(TextureViewTest, FormatsOfOneAndTwoChannels) {
    EXPECT_THAT(colours(view, make<float>(GL_R8, {2, 1, 1}, {1, 0.4f}), plain()), ElementsAre("ffffff", "666666"));
    EXPECT_THAT(colours(view, make<float>(GL_RG16, {1, 1, 1}, {0.2f, 0.6f}), plain()), ElementsAre("339900"));
    ViewerSettings around_zero = plain();
    around_zero.low = -1;
    // What the format does not have stays black, also where black is not zero.
    EXPECT_THAT(colours(view, make<float>(GL_RG16_SNORM, {1, 1, 1}, {-1, -0.2f}), around_zero), ElementsAre("006600"));
    EXPECT_THAT(colours(view, make<float>(GL_RGBA8_SNORM, {1, 1, 1}, {-1, 1, -0.2f, 1}), around_zero),
                ElementsAre("00ff66"));
    EXPECT_THAT(colours(view, make<float>(GL_R11F_G11F_B10F, {1, 1, 1}, {0.25f, 0.75f, 1}), plain()),
                ElementsAre("40bfff"));
}

TEST_F(TextureViewTest, IntegersAndDepth) {
    ViewerSettings automatic = plain();
    automatic.automatic_range = true;
    EXPECT_THAT(colours(view, make<uint32_t>(GL_R32UI, {3, 1, 1}, {0, 1'600'000'000, 4'000'000'000}), automatic),
                ElementsAre("000000", "666666", "ffffff"));
    EXPECT_THAT(colours(view, make<int32_t>(GL_R32I, {3, 1, 1}, {-100, -20, 100}), automatic),
                ElementsAre("000000", "666666", "ffffff"));
    ViewerSettings bytes = plain();
    bytes.high = 255;
    EXPECT_THAT(colours(view, make<uint32_t>(GL_RGBA8UI, {1, 1, 1}, {1, 128, 255, 3}), bytes), ElementsAre("0180ff"));
    EXPECT_THAT(colours(view, make<float>(GL_DEPTH_COMPONENT32F, {3, 1, 1}, {0, 0.0008f, 0.002f}), automatic),
                ElementsAre("000000", "666666", "ffffff"));
    EXPECT_THAT(colours(view, make<float>(GL_DEPTH_COMPONENT24, {1, 1, 1}, {1}), plain()), ElementsAre("ffffff"));
}

TEST_F(TextureViewTest, LayersSlicesAndMips) {
    ViewerSettings settings = plain();
    settings.layer = 1;
    GpuTexture layers = make<float>(GL_R32F, {2, 1, 3}, {0, 0, 0.2f, 0.4f, 1, 1}, TextureKind::texture_2d_array);
    EXPECT_THAT(colours(view, layers, settings), ElementsAre("333333", "666666"));
    GpuTexture depths = make<float>(GL_DEPTH_COMPONENT32F, {1, 1, 2}, {0, 0.6f}, TextureKind::texture_2d_array);
    EXPECT_THAT(colours(view, depths, settings), ElementsAre("999999"));
    GpuTexture counts = make<uint32_t>(GL_R32UI, {1, 1, 2}, {0, 1}, TextureKind::texture_2d_array);
    EXPECT_THAT(colours(view, counts, settings), ElementsAre("ffffff"));

    GpuTexture volume = make<float>(GL_R32F, {2, 2, 2}, {0, 0, 0, 0, 0.2f, 0.4f, 0.6f, 1}, TextureKind::texture_3d, 2);
    upload<float>(volume, {0.8f}, 1);
    EXPECT_THAT(colours(view, volume, settings), ElementsAre("333333", "666666", "999999", "ffffff"));
    settings.mip = 1; // one slice is left: the layer is clamped
    EXPECT_THAT(colours(view, volume, settings), ElementsAre("cccccc"));
    EXPECT_EQ(view.picture().desc().size, glm::ivec3(1, 1, 1));
    GpuTexture ids = make<uint32_t>(GL_R32UI, {1, 1, 2}, {5, 255}, TextureKind::texture_3d);
    ViewerSettings slice = plain();
    slice.layer = 1, slice.high = 255;
    EXPECT_THAT(colours(view, ids, slice), ElementsAre("ffffff"));

    GpuTexture chain = make<float>(GL_RGBA8, {4, 2, 1}, std::vector<float>(32, 0.0f), TextureKind::texture_2d, 3);
    upload<float>(chain, {1, 0, 0, 1, 0, 1, 0, 1}, 1);
    settings.layer = 0;
    EXPECT_THAT(colours(view, chain, settings), ElementsAre("ff0000", "00ff00"));
    EXPECT_EQ(view.picture().desc().size, glm::ivec3(2, 1, 1));
    settings.mip = 99; // clamped
    EXPECT_EQ(colours(view, chain, settings).size(), 1u);
}

TEST_F(TextureViewTest, LooksAtAnotherTextureWithoutItsSampler) {
    // A depth texture that compares would answer 0 or 1.
    GpuTexture depth = make<float>(GL_DEPTH_COMPONENT32F, {1, 1, 1}, {0.4f});
    glTextureParameteri(depth.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    EXPECT_THAT(colours(view, depth, plain()), ElementsAre("666666"));
}

TEST_F(TextureViewTest, LeavesNothingBehind) {
    int before = live_objects().total();
    {
        TextureView other;
        GpuTexture texture = make<float>(GL_R32F, {2, 2, 1}, {0, 1, 2, 3});
        ViewerSettings settings;
        settings.automatic_range = true;
        for (int i = 0; i < 3; ++i)
            other.draw(texture, settings);
    }
    EXPECT_EQ(live_objects().total(), before);
}

TEST_F(TextureViewTest, DefaultsSuitTheResource) {
    TextureDesc colour{TextureKind::texture_2d, GL_RGBA16F, {4, 4, 1}, 1};
    EXPECT_TRUE(default_view("out.radiance", colour).encode_srgb);
    EXPECT_FALSE(default_view("out.radiance", colour).automatic_range);
    EXPECT_EQ(default_view("gbuffer.normal", colour).low, -1);
    EXPECT_FALSE(default_view("gbuffer.normal", colour).encode_srgb);
    EXPECT_FALSE(default_view("out.display", {TextureKind::texture_2d, GL_RGBA8, {4, 4, 1}, 1}).encode_srgb);
    EXPECT_TRUE(
        default_view("gbuffer.depth", {TextureKind::texture_2d, GL_DEPTH_COMPONENT32F, {4, 4, 1}, 1}).automatic_range);
    EXPECT_TRUE(default_view("list.heads", {TextureKind::texture_2d, GL_R32UI, {4, 4, 1}, 1}).automatic_range);
}

TEST_F(TextureViewTest, ReadsSingleTexelsExactly) {
    GpuTexture colour =
        make<float>(GL_RGBA32F, {2, 2, 1}, {0, 0, 0, 0, 1, 2, 3, 4, 0.1f, -5, 1e-7f, 1e30f, 8, 8, 8, 8});
    EXPECT_EQ(to_text(read_texel(colour, 0, {0, 1, 0})), "0.1, -5, 1e-07, 1e+30");
    EXPECT_EQ(to_text(read_texel(colour, 0, {1, 0, 0})), "1, 2, 3, 4");
    EXPECT_EQ(to_text(read_texel(colour, 0, {99, 99, 9})), "8, 8, 8, 8"); // clamped
    // As many digits as tell neighbours apart.
    EXPECT_EQ(to_text(read_texel(make<float>(GL_R16F, {1, 1, 1}, {0.1f}), 0, {})), "0.099976");
    EXPECT_EQ(to_text(read_texel(make<float>(GL_R8, {1, 1, 1}, {55 / 255.0f}), 0, {})), "0.2157");
    EXPECT_EQ(to_text(read_texel(make<float>(GL_R16, {1, 1, 1}, {1 / 65535.0f}), 0, {})), "1.5259e-05");
    GpuTexture bad = make<float>(GL_RG32F, {1, 1, 1}, {k_nan, k_infinity});
    EXPECT_EQ(to_text(read_texel(bad, 0, {})), "nan, inf");
    EXPECT_FALSE(is_finite(read_texel(bad, 0, {})));
    EXPECT_EQ(to_text(read_texel(make<uint32_t>(GL_R32UI, {2, 1, 1}, {7, 4294967295u}), 0, {1, 0, 0})), "4294967295");
    EXPECT_EQ(to_text(read_texel(make<int32_t>(GL_R32I, {1, 1, 1}, {-2147483647}), 0, {})), "-2147483647");
    EXPECT_EQ(to_text(read_texel(make<uint32_t>(GL_RGBA8UI, {1, 1, 1}, {1, 2, 3, 255}), 0, {})), "1, 2, 3, 255");
    EXPECT_EQ(to_text(read_texel(make<float>(GL_DEPTH_COMPONENT32F, {1, 2, 1}, {0.1f, 0.7f}), 0, {0, 1, 0})), "0.7");
    EXPECT_EQ(
        to_text(read_texel(make<float>(GL_R32F, {1, 1, 3}, {1, 2, 3}, TextureKind::texture_2d_array), 0, {0, 0, 2})),
        "3");
    GpuTexture volume = make<float>(GL_R32F, {2, 2, 2}, {0, 0, 0, 0, 0, 0, 6, 0}, TextureKind::texture_3d, 2);
    upload<float>(volume, {42}, 1);
    EXPECT_EQ(to_text(read_texel(volume, 0, {0, 1, 1})), "6");
    EXPECT_EQ(to_text(read_texel(volume, 1, {0, 0, 0})), "42");
}

TEST(TexelAt, CoversTheTexture) {
    EXPECT_EQ(texel_at({0, 0}, {4, 2}), glm::ivec2(0, 0));
    EXPECT_EQ(texel_at({0.999f, 0.5f}, {4, 2}), glm::ivec2(3, 1));
    EXPECT_EQ(texel_at({1, -1}, {4, 2}), glm::ivec2(3, 0));
}

TEST(WorldPosition, FollowsTheProjection) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {2, 1.5f, -4};
    FrameConstants constants;
    set_camera(constants, camera, {64, 36}, 10);
    glm::vec3 point(1.5f, 2.1f, -1);
    glm::vec4 clip = constants.view_projection * glm::vec4(point, 1);
    glm::vec2 place = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(64, 36);
    glm::ivec2 pixel(glm::floor(place));
    auto found = world_position(constants, pixel, clip.z / clip.w);
    ASSERT_TRUE(found);
    // Through the pixel's centre: off by less than a pixel's width at that distance.
    float pixel_width = 2 * constants.tan_half_vfov / 36 * clip.w;
    EXPECT_LT(glm::distance(*found, point), pixel_width);
    EXPECT_NEAR(glm::dot(*found - constants.camera_position, constants.camera_forward), clip.w, 1e-3f);
    EXPECT_FALSE(world_position(constants, pixel, 0));
}

} // namespace
} // namespace bounce
