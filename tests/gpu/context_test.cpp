// The context: what the driver has, its messages, and timers that measure.
#include "core/error.h"
#include "gpu/objects.h"
#include "gpu/program.h"
#include "gpu/timer.h"
#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::HasSubstr;

using Context = GpuTest;

TEST_F(Context, TheReportNamesTheDriverAndMissesNothing) {
    const Capabilities& caps = gpu_context().capabilities();
    EXPECT_TRUE(caps.missing.empty());
    EXPECT_FALSE(caps.renderer.empty());
    EXPECT_GE(caps.limits.at("GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS"), 8);
    std::string text = describe(caps);
    EXPECT_THAT(text, HasSubstr(caps.renderer));
    EXPECT_THAT(text, HasSubstr("nothing that Bounce needs"));
    Capabilities poor = caps;
    poor.missing = {"GL_MAX_IMAGE_UNITS of 8 (this driver has 4)"};
    poor.layer_from_vertex_shader = false;
    EXPECT_THAT(describe(poor), HasSubstr("GL_MAX_IMAGE_UNITS of 8 (this driver has 4)"));
    EXPECT_THAT(describe(poor), HasSubstr("ARB_shader_viewport_layer_array"));
}

TEST_F(Context, IsRobustCoreAndDebug) {
    GLint flags = 0, profile = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_TRUE(flags & GL_CONTEXT_FLAG_DEBUG_BIT);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_EQ(glGetGraphicsResetStatus(), GLenum(GL_NO_ERROR));
}

TEST_F(Context, ErrorsAreCounted) {
    uint64_t before = high_severity_messages();
    glBindTextureUnit(0, 987654);
    EXPECT_EQ(high_severity_messages(), before + 1);
    EXPECT_NE(glGetError(), GLenum(GL_NO_ERROR));
    expected_messages = 1;
}

TEST_F(Context, DevicesAreListedAndAWrongOneIsRefused) {
    std::vector<HeadlessDevice> devices = list_headless_devices();
    EXPECT_THAT(error_of([&] { HeadlessContext(int(devices.size())); }), HasSubstr("--list-devices shows"));
}

TEST_F(Context, TimersMeasureTheWorkBetween) {
    TempFolder folder;
    folder.write(
        "x.comp",
        "layout(local_size_x = 64) in;\nlayout(std430) buffer a_values { uint values[]; };\nuniform int steps;\n"
        "void main() { uint v = gl_GlobalInvocationID.x; for (int i = 0; i < steps; ++i) v = v * 1664525u + "
        "1013904223u; values[v % 64u] = v; }\n");
    Program program("x", {"x.comp"}, folder.path());
    program.scan({}, {});
    ASSERT_TRUE(program.build({}));
    Buffer values(256, nullptr, "values");
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    glUseProgram(program.id());
    TimerMode mode = probe_timer_mode();
    glUseProgram(program.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, values.id());
    auto milliseconds = [&](int steps) {
        set_uniform(program.id(), program.interface().uniforms[0], steps);
        GpuTimer timer(mode);
        double best = 1e9;
        for (int i = 0; i < 4; ++i) {
            timer.begin();
            glDispatchCompute(64, 1, 1);
            timer.end();
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT); // the next one writes the same values
            glFinish();
            if (auto ms = timer.take()) best = std::min(best, *ms);
        }
        EXPECT_FALSE(timer.take().has_value());
        return best;
    };
    milliseconds(1); // compiles
    double little = milliseconds(100), much = milliseconds(20000);
    EXPECT_LT(much, 1e9);
    EXPECT_GT(much, 0);
    EXPECT_GT(much, little) << "two hundred times the work takes longer";
    glUseProgram(0);
}

TEST_F(Context, TimersLeaveNoQueries) {
    int before = live_objects().queries;
    {
        GpuTimer timer(TimerMode::queries);
        for (int i = 0; i < 10; ++i) {
            timer.begin();
            timer.end();
        }
        GpuTimer moved = std::move(timer);
        EXPECT_EQ(live_objects().queries, before + 8);
    }
    EXPECT_EQ(live_objects().queries, before);
}
