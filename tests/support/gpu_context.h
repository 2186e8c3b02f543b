#pragma once
// One OpenGL context for a test program, and the rule that no test may leave an OpenGL error or a message of high
// severity behind.

#include "app/hosts/headless.h"
#include "gpu/capabilities.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

namespace bounce {

inline const HeadlessContext& gpu_context() {
    static HeadlessContext context;
    return context;
}

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        gpu_context();
        messages_ = high_severity_messages();
    }
    void TearDown() override {
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << "an OpenGL error was left behind";
        EXPECT_EQ(high_severity_messages() - messages_, expected_messages) << "messages of high severity";
    }
    /// Where a test provokes messages on purpose.
    uint64_t expected_messages = 0;

  private:
    uint64_t messages_ = 0;
};

} // namespace bounce
