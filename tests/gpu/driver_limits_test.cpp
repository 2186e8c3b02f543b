// Limits, pretended ones, and what the driver says of its memory.
#include "core/error.h"
#include "gpu/context_loss.h"
#include "gpu/device_memory.h"
#include "gpu/driver_limits.h"
#include "gpu/objects.h"
#include "support/errors.h"
#include "support/fake_driver.h"
#include "support/gpu_context.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;

class DriverLimits : public GpuTest {
  protected:
    void TearDown() override {
        pretend_limits("");
        GpuTest::TearDown();
    }
};

TEST_F(DriverLimits, TheMinimumIsPretendedAndNothingIsRaised) {
    for (const DriverLimit& limit : driver_limits()) {
        const int64_t own = driver_limit(limit.name);
        EXPECT_EQ(own, true_limit(limit.name)) << limit.text;
        EXPECT_GE(own, limit.minimum) << limit.text << ": this driver has less than OpenGL 4.6 asks for";
        pretend_limits("minimum");
        EXPECT_EQ(driver_limit(limit.name), std::min(own, limit.minimum)) << limit.text;
        pretend_limits(std::string(limit.text) + "=2");
        EXPECT_EQ(driver_limit(limit.name), std::min<int64_t>(own, 2)) << limit.text;
        pretend_limits(std::string(limit.text) + "=1000000000000000000");
        EXPECT_EQ(driver_limit(limit.name), own) << limit.text;
        pretend_limits("");
    }
    pretend_limits("minimum");
    EXPECT_EQ(driver_limit(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 1), 1024);
    EXPECT_EQ(driver_limit(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 2), 64);
    EXPECT_FALSE(driver_has("GL_ARB_shader_viewport_layer_array"));
    EXPECT_FALSE(read_capabilities().layer_from_vertex_shader);
    EXPECT_TRUE(read_capabilities().missing.empty());
}

TEST_F(DriverLimits, WrongOnesAreTold) {
    EXPECT_THAT(error_of([] { pretend_limits("minimun"); }),
                AllOf(HasSubstr("invalid --limits 'minimun'"), HasSubstr("minimum")));
    EXPECT_THAT(error_of([] { pretend_limits("GL_MAX_IMAGE_UNIT=4"); }),
                HasSubstr("did you mean 'GL_MAX_IMAGE_UNITS'?"));
    for (const char* value : {"", "=", "=x", "=-1", "=4.5", "=99999999999999999999"})
        EXPECT_THAT(error_of([&] { pretend_limits(std::string("minimum, GL_MAX_IMAGE_UNITS") + value); }),
                    HasSubstr("a whole number from 0"))
            << value;
}

TEST_F(DriverLimits, FreeMemoryIsWhatTheGpuSays) {
    EXPECT_TRUE(device_memory().is_main) << "a software driver";
    {
        FakeGpu gpu("GL_NVX_gpu_memory_info", 300, 500);
        EXPECT_EQ(device_memory().free, 300u * 1024);
        EXPECT_FALSE(device_memory().is_main);
    }
    {
        FakeGpu gpu("GL_ATI_meminfo", 300, 500);
        EXPECT_EQ(device_memory().free, 500u * 1024);
    }
    FakeGpu gpu("GL_none", 300, 500);
    EXPECT_EQ(device_memory().free, ~uint64_t(0)) << "not known";
}

TEST_F(DriverLimits, OutOfMemoryIsTold) {
    const LiveObjects before = live_objects();
    const auto full = +[](GLuint, GLsizei, GLenum, GLsizei, GLsizei) {};
    static int errors = 0;
    const auto error = +[]() -> GLenum { return errors-- > 0 ? GL_OUT_OF_MEMORY : GL_NO_ERROR; };
    {
        Fake storage(glad_glTextureStorage2D, full);
        Fake told(
            glad_glGetError, +[]() -> GLenum { return GL_OUT_OF_MEMORY; }); // every time, as some drivers do
        EXPECT_THROW(GpuTexture({TextureKind::texture_2d, GL_RGBA8, {64, 64, 1}, 1}, "big"), OutOfDeviceMemory);
    }
    {
        Fake told(glad_glGetError, error);
        errors = 3;
        EXPECT_TRUE(drop_errors());
        EXPECT_FALSE(drop_errors());
    }
    EXPECT_EQ(live_objects().total(), before.total());
}

/// A lost context tells of it at every call: nothing waits for it to end.
TEST_F(DriverLimits, ALostContextIsNoEndlessError) {
    Fake told(
        glad_glGetError, +[]() -> GLenum { return GL_CONTEXT_LOST; });
    EXPECT_FALSE(drop_errors());
    EXPECT_THAT(error_of([] { Buffer(16, nullptr, "void"); }), HasSubstr("0x507"));
}

/// Drivers tell of a reset once.
TEST_F(DriverLimits, AResetIsRememberedUntilThereIsAnotherContext) {
    static GLenum status = GL_NO_ERROR;
    Fake told(
        glad_glGetGraphicsResetStatus, +[]() -> GLenum { return std::exchange(status, GLenum(GL_NO_ERROR)); });
    EXPECT_FALSE(context_is_lost());
    status = GL_GUILTY_CONTEXT_RESET;
    EXPECT_EQ(context_reset(), ResetCause::guilty);
    EXPECT_EQ(context_reset(), ResetCause::guilty);
    forget_reset();
    EXPECT_FALSE(context_is_lost());
    status = GL_INNOCENT_CONTEXT_RESET;
    EXPECT_EQ(context_reset(), ResetCause::innocent);
    forget_reset();
}
