// The watched calls of OpenGL: what is bound is found, whatever it is bound to, and a missing barrier is told.
#include "gpu/call_watch.h"
#include "gpu/objects.h"
#include "gpu/program.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;

namespace {

class CallWatch : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        texture = GpuTexture({TextureKind::texture_2d, GL_R32F, {4, 4, 1}, 2}, "a.texture");
        sum = Buffer(16, nullptr, "a.sum");
    }
    GLuint program(const std::string& name, const std::string& body) {
        folder.write(name + ".comp", "layout(local_size_x = 1) in;\n" + body);
        programs_.push_back(
            std::make_unique<Program>(name, std::vector<std::filesystem::path>{name + ".comp"}, folder.path()));
        programs_.back()->scan({}, {});
        EXPECT_TRUE(programs_.back()->build({}));
        return programs_.back()->id();
    }
    GLuint storer() {
        return program("store", "layout(r32f) writeonly uniform image2D a_out;\n"
                                "void main() { imageStore(a_out, ivec2(0), vec4(1)); }\n");
    }
    GLuint sampling() {
        return program("sample", "uniform sampler2D a_in;\nlayout(std430) writeonly buffer a_sum { float sum; };\n"
                                 "void main() { sum = texelFetch(a_in, ivec2(0), 0).r; }\n");
    }
    static void run(GLuint which) {
        glUseProgram(which);
        glDispatchCompute(1, 1, 1);
    }
    void store(const GpuTexture& to, int mip = 0) {
        glBindImageTexture(0, to.id(), mip, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        run(store_ ? store_ : store_ = storer());
    }
    void sample(const GpuTexture& from) {
        glBindTextureUnit(0, from.id());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sum.id());
        run(sample_ ? sample_ : sample_ = sampling());
    }
    static std::string last() { return hazard_check().hazards().empty() ? "" : hazard_check().hazards().back(); }

    TempFolder folder;
    GpuTexture texture;
    Buffer sum;

  private:
    std::vector<std::unique_ptr<Program>> programs_;
    GLuint store_ = 0, sample_ = 0;
};

} // namespace

TEST_F(CallWatch, AMissingBarrierIsToldWithPassObjectAndBit) {
    {
        DebugGroup group("first");
        store(texture);
    }
    DebugGroup group("second");
    sample(texture);
    EXPECT_THAT(last(), AllOf(HasSubstr("pass 'second'"), HasSubstr("dispatch of 'sample'"), HasSubstr("'a.texture'"),
                              HasSubstr("sampler 'a_in'"), HasSubstr("pass 'first'"), HasSubstr("image 'a_out'"),
                              HasSubstr("GL_TEXTURE_FETCH_BARRIER_BIT")));
    expected_hazards = 1;
}

TEST_F(CallWatch, WithTheBarrierAllIsWell) {
    store(texture);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    sample(texture);
    ASSERT_EQ(hazard_check().barriers().size(), 1u);
    EXPECT_EQ(hazard_check().barriers()[0].needed, GLbitfield(GL_TEXTURE_FETCH_BARRIER_BIT));
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    store(texture);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    EXPECT_EQ(texture.read().front(), 1);
}

TEST_F(CallWatch, AViewIsPartOfItsOrigin) {
    const GpuTexture coarse = texture.view(TextureKind::texture_2d, 1, 1, 0, 1),
                     fine = texture.view(TextureKind::texture_2d, 0, 1, 0, 1);
    store(texture, 1);
    sample(fine);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT); // of the sum
    const size_t before = hazard_check().hazards().size();
    sample(coarse);
    EXPECT_EQ(hazard_check().hazards().size(), before + 1) << "the fine mip was not written";
    EXPECT_THAT(last(), HasSubstr("'a.texture' mip 1"));
    expected_hazards = 1;
}

TEST_F(CallWatch, ReadBacksUploadsAndCopiesNeedTheirBits) {
    store(texture);
    texture.read();
    EXPECT_THAT(last(), AllOf(HasSubstr("read-back"), HasSubstr("GL_TEXTURE_UPDATE_BARRIER_BIT")));
    sample(texture); // without a barrier, and what wrote the sum before is unordered with what writes it now
    float value = 0;
    sum.read(0, 4, &value);
    EXPECT_THAT(last(), AllOf(HasSubstr("read-back"), HasSubstr("'a.sum'"), HasSubstr("GL_BUFFER_UPDATE_BARRIER_BIT")));
    expected_hazards = 3;
}

TEST_F(CallWatch, AnImageOfAnotherFormatIsTold) {
    const GpuTexture other{{TextureKind::texture_2d, GL_R32UI, {4, 4, 1}, 1}, "a.other"};
    glBindImageTexture(0, other.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
    run(storer());
    EXPECT_THAT(last(), AllOf(HasSubstr("a_out"), HasSubstr("'a.other'"), HasSubstr("another format")));
    expected_hazards = 1;
}

TEST_F(CallWatch, FeedbackWithinADispatchIsTold) {
    const GLuint both =
        program("both", "uniform sampler2D a_in;\nlayout(r32f) writeonly uniform image2D a_out;\n"
                        "void main() { imageStore(a_out, ivec2(0), texelFetch(a_in, ivec2(1), 0)); }\n");
    glBindTextureUnit(0, texture.id());
    glBindImageTexture(0, texture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    run(both);
    EXPECT_THAT(last(), AllOf(HasSubstr("within a command"), HasSubstr("a_in"), HasSubstr("a_out")));
    expected_hazards = 1;
}

TEST_F(CallWatch, ABarrierThatIsOverlookedIsMissed) {
    store(texture);
    overlook_barrier(0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    sample(texture);
    EXPECT_THAT(last(), HasSubstr("GL_TEXTURE_FETCH_BARRIER_BIT"));
    expected_hazards = 1;
    glMemoryBarrier(GL_ALL_BARRIER_BITS); // only that one was
    sample(texture);
}
