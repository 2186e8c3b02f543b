// OpenGL objects: sizes, mips, views, clears and readback of every format; nothing is left behind.
#include "gpu/objects.h"
#include "support/errors.h"
#include "support/gpu_context.h"

#include <cmath>
#include <gmock/gmock.h>

using namespace bounce;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

class Objects : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        before_ = live_objects().total();
    }
    void TearDown() override {
        EXPECT_EQ(live_objects().total(), before_) << "an object was left behind";
        GpuTest::TearDown();
    }

  private:
    int before_ = 0;
};

TEST_F(Objects, MipSizesAndBytes) {
    TextureDesc flat{TextureKind::texture_2d, GL_RGBA16F, {37, 18, 1}, 6};
    EXPECT_EQ(full_mip_count(flat), 6);
    EXPECT_EQ(mip_size(flat, 2), glm::ivec3(9, 4, 1));
    EXPECT_EQ(mip_size(flat, 5), glm::ivec3(1, 1, 1));
    EXPECT_EQ(texture_bytes(flat), 8u * (37 * 18 + 18 * 9 + 9 * 4 + 4 * 2 + 2 * 1 + 1));
    TextureDesc array{TextureKind::texture_2d_array, GL_R8, {8, 8, 5}, 4};
    EXPECT_EQ(mip_size(array, 3), glm::ivec3(1, 1, 5)) << "layers stay";
    EXPECT_EQ(texture_bytes(array), 5u * (64 + 16 + 4 + 1));
    TextureDesc volume{TextureKind::texture_3d, GL_R32UI, {4, 4, 16}, 5};
    EXPECT_EQ(full_mip_count(volume), 5);
    EXPECT_EQ(mip_size(volume, 1), glm::ivec3(2, 2, 8));
    EXPECT_EQ(texture_bytes(volume), 4u * (256 + 32 + 4 + 2 + 1));
}

/// What the driver holds is what the table of formats says: bytes, channels, class.
TEST_F(Objects, EveryFormatIsAsItsRowSays) {
    for (const std::string& name : format_names()) {
        const Format& format = format_by_name(name);
        EXPECT_EQ(&format_by_enum(format.internal), &format);
        GpuTexture texture({TextureKind::texture_2d, format.internal, {3, 2, 1}, 1}, name);
        GLint bits[6] = {};
        const GLenum parts[] = {GL_TEXTURE_RED_SIZE,   GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                                GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_SHARED_SIZE};
        int sum = 0, channels = 0;
        for (int i = 0; i < 6; ++i) {
            glGetTextureLevelParameteriv(texture.id(), 0, parts[i], &bits[i]);
            sum += bits[i];
            channels += bits[i] > 0;
        }
        EXPECT_EQ(channels, format.channels) << name;
        EXPECT_EQ((sum + 7) / 8, name == "depth24" ? 3 : format.bytes) << name;
        GLint supported = 0;
        glGetInternalformativ(GL_TEXTURE_2D, format.internal, GL_SHADER_IMAGE_STORE, 1, &supported);
        if (format.image) {
            EXPECT_EQ(supported, GL_FULL_SUPPORT) << name << " can be stored to";
        }
    }
    EXPECT_THAT(error_of([] { format_by_name("rgba16"); }), "");
    EXPECT_THAT(error_of([] { format_by_name("rgba_16f"); }),
                HasSubstr("there is no format 'rgba_16f' (did you mean 'rgba16f'?)"));
    EXPECT_THAT(error_of([] { format_by_enum(GL_RGB9_E5); }), HasSubstr("not one that Bounce uses"));
}

TEST_F(Objects, ClearsOfEveryFormatReadBack) {
    for (const std::string& name : format_names()) {
        const Format& format = format_by_name(name);
        GpuTexture texture({TextureKind::texture_2d, format.internal, {4, 4, 1}, 3}, name);
        texture.clear({1, 0, 1, 1});
        texture.clear(glm::vec4(0), 1);
        std::vector<float> top = texture.read(0), middle = texture.read(1);
        ASSERT_EQ(top.size(), 16u * size_t(format.channels)) << name;
        ASSERT_EQ(middle.size(), 4u * size_t(format.channels)) << name;
        const float expected[4] = {1, 0, 1, 1};
        for (size_t i = 0; i < top.size(); ++i)
            ASSERT_EQ(top[i], expected[i % size_t(format.channels)]) << name << " value " << i;
        EXPECT_THAT(middle, Each(0)) << name;
        EXPECT_EQ(texture.read(2)[0], 1) << name;
    }
}

TEST_F(Objects, ClearValuesKeepTheirPrecisionAndSign) {
    GpuTexture real({TextureKind::texture_2d, GL_R32F, {1, 1, 1}, 1}, "real");
    real.clear(glm::vec4(-0.1f));
    EXPECT_THAT(real.read(), ElementsAre(-0.1f));
    GpuTexture integer({TextureKind::texture_2d, GL_R32I, {1, 1, 1}, 1}, "integer");
    integer.clear(glm::vec4(-5));
    EXPECT_THAT(integer.read(), ElementsAre(-5));
    GpuTexture natural({TextureKind::texture_2d, GL_R32UI, {1, 1, 1}, 1}, "natural");
    uint32_t big = 0xfffffffeu;
    glTextureSubImage2D(natural.id(), 0, 0, 0, 1, 1, GL_RED_INTEGER, GL_UNSIGNED_INT, &big);
    EXPECT_THAT(natural.read_integers(), ElementsAre(0xfffffffeu));
}

TEST_F(Objects, ReadbackOfOddWidthsAndOfLayersAndSlices) {
    GpuTexture bytes({TextureKind::texture_2d, GL_R8, {3, 2, 1}, 1}, "bytes");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const uint8_t values[] = {0, 51, 102, 153, 204, 255};
    glTextureSubImage2D(bytes.id(), 0, 0, 0, 3, 2, GL_RED, GL_UNSIGNED_BYTE, values);
    EXPECT_THAT(bytes.read(), testing::Pointwise(testing::FloatNear(1e-6f), {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}));
    for (TextureKind kind : {TextureKind::texture_2d_array, TextureKind::texture_3d}) {
        GpuTexture stack({kind, GL_R32F, {1, 2, 3}, 1}, "stack");
        const float slices[] = {1, 2, 3, 4, 5, 6};
        glTextureSubImage3D(stack.id(), 0, 0, 0, 0, 1, 2, 3, GL_RED, GL_FLOAT, slices);
        EXPECT_THAT(stack.read(), ElementsAre(1, 2, 3, 4, 5, 6));
    }
}

TEST_F(Objects, ViewsLookAtOneMipAndLayer) {
    GpuTexture array({TextureKind::texture_2d_array, GL_R32F, {4, 4, 3}, 3}, "array");
    array.clear(glm::vec4(1));
    GpuTexture view = array.view(TextureKind::texture_2d, 1, 1, 2, 1);
    EXPECT_EQ(view.desc().size, glm::ivec3(2, 2, 1));
    EXPECT_EQ(live_objects().views, 1);
    view.clear(glm::vec4(5));
    EXPECT_THAT(view.read(), Each(5));
    EXPECT_THAT(array.read(1), ElementsAre(1, 1, 1, 1, 1, 1, 1, 1, 5, 5, 5, 5));
    EXPECT_THAT(array.read(0), Each(1));
    GpuTexture volume({TextureKind::texture_3d, GL_RGBA8, {4, 4, 4}, 3}, "volume");
    EXPECT_EQ(volume.view(TextureKind::texture_3d, 2, 1, 0, 1).desc().size, glm::ivec3(1, 1, 1));
    GpuTexture bits = array.view(TextureKind::texture_2d, 0, 1, 0, 1, GL_R32UI);
    EXPECT_EQ(bits.read_integers()[0], 0x3f800000u) << "the same bits in another format";
}

TEST_F(Objects, SizesThatCannotBeAreRefused) {
    auto refusal = [](glm::ivec3 size, TextureKind kind, int mips) {
        return error_of([&] { GpuTexture({kind, GL_R8, size, mips}, "it"); });
    };
    EXPECT_THAT(refusal({0, 4, 1}, TextureKind::texture_2d, 1), HasSubstr("texture 'it' would be 0×4×1"));
    EXPECT_THAT(refusal({1 << 20, 4, 1}, TextureKind::texture_2d, 1), HasSubstr("this driver allows"));
    EXPECT_THAT(refusal({4, 4, 2}, TextureKind::texture_2d, 1), HasSubstr("4×4×2"));
    EXPECT_THAT(refusal({4, 4, 1 << 20}, TextureKind::texture_2d_array, 1), HasSubstr("this driver allows"));
    EXPECT_THAT(refusal({4, 4, 1}, TextureKind::texture_2d, 4), HasSubstr("has 1 … 3 mips, not 4"));
    GpuTexture a({TextureKind::texture_2d, GL_RGBA8, {4, 4, 1}, 1}, "colour"),
        b({TextureKind::texture_2d, GL_R11F_G11F_B10F, {4, 4, 1}, 1}, "b");
    EXPECT_THAT(error_of([&] {
                    Framebuffer({}, {&a, 0, -1}, "odd one");
                }),
                HasSubstr("framebuffer 'odd one' is incomplete"));
}

TEST_F(Objects, MovingTakesTheObjectAlong) {
    LiveObjects start = live_objects();
    GpuTexture a({TextureKind::texture_2d, GL_R8, {4, 4, 1}, 1}, "a");
    GLuint id = a.id();
    GpuTexture b = std::move(a);
    EXPECT_EQ(b.id(), id);
    EXPECT_EQ(a.id(), 0u);
    EXPECT_EQ(b.name(), "a");
    GpuTexture c({TextureKind::texture_2d, GL_R8, {8, 8, 1}, 1}, "c");
    EXPECT_EQ(live_objects().textures, start.textures + 2);
    c = std::move(b);
    EXPECT_EQ(live_objects().textures, start.textures + 1) << "what stood there is gone";
    EXPECT_EQ(c.desc().size.x, 4);
    GpuTexture& same = c;
    c = std::move(same);
    EXPECT_EQ(c.id(), id) << "a move onto itself changes nothing";

    Buffer x(16, nullptr, "x"), y = std::move(x);
    EXPECT_EQ(x.id(), 0u);
    EXPECT_EQ(x.bytes(), 0u);
    EXPECT_EQ(y.bytes(), 16u);
    Sampler s(GL_LINEAR, GL_LINEAR, GL_REPEAT, "s"), t = std::move(s);
    VertexArray v("v"), w = std::move(v);
    Framebuffer f({{&c, 0, -1}}, {}, "f"), g = std::move(f);
    EXPECT_EQ(live_objects().samplers, start.samplers + 1);
    EXPECT_EQ(live_objects().vertex_arrays, start.vertex_arrays + 1);
    EXPECT_EQ(live_objects().framebuffers, start.framebuffers + 1);
    EXPECT_EQ(s.id() + v.id() + f.id(), 0u);
}

TEST_F(Objects, Buffers) {
    const uint32_t data[] = {1, 2, 3, 4, 5};
    Buffer buffer(sizeof data, data, "numbers");
    EXPECT_THAT(buffer.read_all<uint32_t>(), ElementsAre(1, 2, 3, 4, 5));
    const uint32_t two[] = {20, 30};
    buffer.update(4, 8, two);
    EXPECT_THAT(buffer.read_all<uint32_t>(), ElementsAre(1, 20, 30, 4, 5));
    uint32_t one = 0;
    buffer.read(12, 4, &one);
    EXPECT_EQ(one, 4u);
    buffer.clear(7);
    EXPECT_THAT(buffer.read_all<uint32_t>(), Each(7));
    Buffer empty(0, nullptr, "empty");
    EXPECT_EQ(empty.bytes(), 0u);
    EXPECT_NE(empty.id(), 0u) << "an empty list can still be bound";
    GLint immutable = 0;
    glGetNamedBufferParameteriv(buffer.id(), GL_BUFFER_IMMUTABLE_STORAGE, &immutable);
    EXPECT_TRUE(immutable);
    char label[32] = {};
    glGetObjectLabel(GL_BUFFER, buffer.id(), sizeof label, nullptr, label);
    EXPECT_STREQ(label, "numbers");
}

/// A buffer whose length is no multiple of four bytes is cleared to its last byte.
TEST_F(Objects, BuffersOfOddLengthsAreClearedWhole) {
    std::vector<uint8_t> ones(18, 1);
    Buffer buffer(ones.size(), ones.data(), "odd");
    buffer.clear(0);
    EXPECT_THAT(buffer.read_all<uint8_t>(), Each(0));
}

TEST_F(Objects, FramebuffersOfOneMipAndLayer) {
    GpuTexture array({TextureKind::texture_2d_array, GL_RGBA8, {4, 4, 2}, 2}, "array");
    array.clear(glm::vec4(0));
    Framebuffer target({{&array, 1, 1}}, {}, "one layer of mip 1");
    const float red[] = {1, 0, 0, 1};
    glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, red);
    std::vector<float> texels = array.read(1);
    ASSERT_EQ(texels.size(), 2u * 2 * 2 * 4);
    EXPECT_EQ(texels[0], 0) << "layer 0 is untouched";
    EXPECT_EQ(texels[16], 1);
    EXPECT_THAT(array.read(0), Each(0));
}
