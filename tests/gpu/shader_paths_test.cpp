// Shaders are read from below the folder of shaders only.

#include "gpu/shader_paths.h"

#include "gpu/shader_source.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

namespace bounce {

namespace fs = std::filesystem;
using testing::HasSubstr;

namespace {

class ShaderPaths : public testing::Test {
  protected:
    ShaderPaths() {
        folder.write("glsl/lib/in.glsl", "float within;\n");
        folder.write("out.glsl", "float outside;\n");
    }
    /// What is told of a stage with this include; "" when it is read.
    std::string told(const std::string& include) {
        folder.write("glsl/a/main.comp", "// top\n#include \"" + include + "\"\nvoid main() {}\n");
        const ShaderSource source = expand_shader("a/main.comp", folder / "glsl", {}, {});
        EXPECT_EQ(source.text.find("outside"), std::string::npos) << include;
        return source.errors.empty() ? "" : source.errors.front().text();
    }
    TempFolder folder;
};

} // namespace

TEST_F(ShaderPaths, IncludesStayBelowTheFolder) {
    EXPECT_EQ(told("../lib/in.glsl"), "");
    EXPECT_EQ(told("lib/in.glsl"), "");
    EXPECT_EQ(told("lib/../lib/in.glsl"), "");
    for (const std::string& bad : {std::string("../../out.glsl"), (folder / "out.glsl").string(),
                                   std::string("/etc/hostname"), std::string("../a/../../out.glsl")})
        EXPECT_THAT(told(bad), testing::AllOf(HasSubstr("a/main.comp:2"), HasSubstr("invalid shader file"),
                                              HasSubstr("expected one below")))
            << bad;
}

TEST_F(ShaderPaths, LinksDoNotLeadOut) {
    fs::create_symlink(folder / "out.glsl", folder / "glsl/lib/link.glsl");
    EXPECT_THAT(told("lib/link.glsl"), HasSubstr("invalid shader file"));
    fs::create_symlink(folder / "glsl/lib/in.glsl", folder / "glsl/lib/same.glsl");
    EXPECT_EQ(told("lib/same.glsl"), "");
    // The user's own folder may lie elsewhere.
    folder.write("mine/own.glsl", "float own;\n");
    fs::create_directory_symlink(folder / "mine", folder / "glsl/user");
    EXPECT_EQ(told("user/own.glsl"), "");
}

TEST_F(ShaderPaths, OnlyRegularFilesOfALimitedSize) {
    ASSERT_EQ(::mkfifo((folder / "glsl/lib/pipe.glsl").c_str(), 0600), 0);
    EXPECT_THAT(told("lib/pipe.glsl"), HasSubstr("it is a pipe; expected a regular file"));
    fs::resize_file(folder / "glsl/lib/in.glsl", uintmax_t(1) << 33);
    EXPECT_THAT(told("lib/in.glsl"), HasSubstr("more than 4194304 bytes (text_bytes)"));
}

TEST_F(ShaderPaths, StagesStayThereToo) {
    folder.write("out.comp", "float outside;\n");
    for (const std::string& stage : {std::string("../out.comp"), (folder / "out.comp").string()}) {
        const ShaderSource source = expand_shader(stage, folder / "glsl", {}, {});
        ASSERT_EQ(source.errors.size(), 1u) << stage;
        EXPECT_THAT(source.errors.front().text(), HasSubstr("invalid shader file"));
    }
}

} // namespace bounce
