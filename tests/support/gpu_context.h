#pragma once
// One OpenGL context for a test program, and the rule that no test may leave an OpenGL error, a message of high
// severity or a hazard behind.

#include "app/hosts/headless.h"
#include "gpu/call_watch.h"
#include "gpu/capabilities.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

namespace bounce {

inline HeadlessContext& gpu_context() {
    static HeadlessContext context = [] {
        want_call_watch();
        return HeadlessContext();
    }();
    return context;
}

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        gpu_context();
        messages_ = high_severity_messages();
        hazards_ = hazard_check().hazards().size();
        hazard_check().forget_barriers();
    }
    void TearDown() override {
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << "an OpenGL error was left behind";
        EXPECT_EQ(high_severity_messages() - messages_, expected_messages) << "messages of high severity";
        const std::vector<std::string>& hazards = hazard_check().hazards();
        const size_t found = hazards.size() - std::min(hazards.size(), hazards_);
        EXPECT_EQ(found, expected_hazards) << "hazards, the last: " << (hazards.empty() ? "" : hazards.back());
    }
    /// Where a test provokes messages on purpose.
    uint64_t expected_messages = 0;
    size_t expected_hazards = 0;

  private:
    uint64_t messages_ = 0;
    size_t hazards_ = 0;
};

} // namespace bounce
