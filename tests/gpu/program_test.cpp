// Programs, by the real driver: the last good one stays, errors are told where they are written.
#include "gpu/objects.h"
#include "gpu/program.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class Programs : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        before_ = live_objects().programs;
    }
    void TearDown() override {
        EXPECT_EQ(live_objects().programs, before_);
        GpuTest::TearDown();
    }
    TempFolder folder;

  private:
    int before_ = 0;
};

TEST_F(Programs, TheLastGoodOneStays) {
    folder.write("x.comp", "layout(local_size_x = 4, local_size_y = 2) in;\nvoid main() {}\n");
    Program program("x", {"x.comp"}, folder.path());
    EXPECT_FALSE(program.usable());
    program.scan({}, {});
    ASSERT_TRUE(program.build({}));
    GLuint good = program.id();
    EXPECT_TRUE(program.usable() && program.up_to_date());
    EXPECT_EQ(program.interface().local_size, glm::ivec3(4, 2, 1));

    folder.write("x.comp", "layout(local_size_x = 4) in;\nvoid main() { oops(); }\n");
    program.files_changed();
    program.scan({}, {});
    EXPECT_FALSE(program.build({}));
    EXPECT_EQ(program.id(), good);
    EXPECT_TRUE(program.usable());
    EXPECT_FALSE(program.up_to_date());
    EXPECT_THAT(program.errors(), testing::Not(IsEmpty()));
    EXPECT_EQ(program.interface().local_size, glm::ivec3(4, 2, 1)) << "of the program that runs";

    folder.write("x.comp", "layout(local_size_x = 8) in;\nvoid main() {}\n");
    program.files_changed();
    program.scan({}, {});
    EXPECT_TRUE(program.build({}));
    EXPECT_NE(program.id(), 0u);
    EXPECT_THAT(program.errors(), IsEmpty());
    EXPECT_EQ(program.interface().local_size.x, 8);

    EXPECT_FALSE([&] {
        program.files_changed();
        program.scan({}, {});
        return program.build([](const ProgramInterface&) { return std::vector<std::string>{"not like this"}; });
    }()) << "the check of the interface may refuse it";
    EXPECT_THAT(program.errors().at(0).message, HasSubstr("not like this"));
    EXPECT_TRUE(program.usable());

    program.release();
    EXPECT_FALSE(program.usable());
    program.restore();
    EXPECT_TRUE(program.usable()) << "the last good text, though the newest is refused";
    EXPECT_EQ(program.interface().local_size.x, 8);
    EXPECT_THAT(program.errors().at(0).message, HasSubstr("not like this"));

    program.disable("it hung");
    EXPECT_FALSE(program.usable());
    EXPECT_TRUE(program.disabled());
    EXPECT_EQ(program.why_disabled(), "it hung");
    program.release();
    program.restore();
    EXPECT_FALSE(program.usable()) << "what hung is not made again";
}

/// An error in an include behind a hoisted extension and injected defines: the driver's line is that of the flat text.
TEST_F(Programs, TheDriversErrorsAreTranslatedToFileAndLine) {
    folder.write("x.comp",
                 "#version 460\n#include \"lib/a.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { a(); }\n");
    folder.write("lib/a.glsl",
                 "// a\n#extension GL_ARB_shader_ballot : enable\n#include \"b.glsl\"\nvoid a() { b(); }\n");
    folder.write("lib/b.glsl", "// b\n\n\nvoid b() { undeclared_thing += 1; }\n");
    Program program("x", {"x.comp"}, folder.path());
    program.scan({{"ONE", "1"}, {"TWO", "2"}}, {});
    EXPECT_FALSE(program.build({}));
    ASSERT_FALSE(program.errors().empty());
    const ShaderError& error = program.errors()[0];
    EXPECT_EQ(error.file, "lib/b.glsl");
    EXPECT_EQ(error.line, 4);
    EXPECT_EQ(error.source_line, "void b() { undeclared_thing += 1; }");
    EXPECT_THAT(error.message, HasSubstr("undeclared_thing"));
    EXPECT_THAT(error.text(), HasSubstr("lib/b.glsl:4: "));
}

TEST_F(Programs, StagesThatDoNotGoTogether) {
    folder.write("x.vert", "out vec3 colour;\nvoid main() { colour = vec3(1); gl_Position = vec4(0); }\n");
    folder.write("x.frag",
                 "in vec4 colour;\nlayout(location = 0) out vec4 result;\nvoid main() { result = colour; }\n");
    Program program("x", {"x.vert", "x.frag"}, folder.path());
    program.scan({}, {});
    EXPECT_FALSE(program.build({}));
    ASSERT_FALSE(program.errors().empty());
    EXPECT_THAT(program.errors()[0].message, HasSubstr("does not link"));
    EXPECT_THAT(program.errors()[0].message, HasSubstr("colour"));
    EXPECT_THAT(program.errors()[0].file.string(), testing::AnyOf("x.vert", "x.frag"));
}

TEST_F(Programs, AFunctionThatNothingDefines) {
    folder.write("x.comp", "layout(local_size_x = 1) in;\nvoid nowhere();\nvoid main() { nowhere(); }\n");
    Program program("x", {"x.comp"}, folder.path());
    program.scan({}, {});
    EXPECT_FALSE(program.build({}));
    ASSERT_EQ(program.errors().size(), 1u);
    EXPECT_THAT(program.errors()[0].text(),
                AllOf(HasSubstr("x.comp"), HasSubstr("does not link"), HasSubstr("nowhere")));
}

TEST_F(Programs, WhatCannotBeReadForTheMomentKeepsItsSlotsAndParameters) {
    std::string text = "layout(local_size_x = 1) in;\nuniform sampler2D a_b;\nuniform float gain = 1.0; //! [0, 2] "
                       "gain\nvoid main() {}\n";
    folder.write("x.comp", text);
    Program program("x", {"x.comp"}, folder.path());
    program.scan({}, {});
    folder.remove("x.comp");
    for (int i = 0; i < 2; ++i) {
        program.files_changed();
        program.scan({}, {});
        EXPECT_FALSE(program.errors().empty());
        EXPECT_EQ(program.slots().size(), 1u);
        EXPECT_EQ(program.parameters().size(), 1u);
        EXPECT_THAT(program.files(), testing::ElementsAre(folder / "x.comp")) << "it is watched for";
    }
    folder.write("x.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
    program.files_changed();
    program.scan({}, {});
    EXPECT_TRUE(program.slots().empty());
    EXPECT_TRUE(program.parameters().empty());
}

TEST_F(Programs, UnitsAndBindingsAreGivenInOrder) {
    folder.write("x.comp", R"(layout(local_size_x = 1) in;
uniform sampler2D a_one;
uniform usampler3D a_two;
layout(rgba8) uniform image2D a_image;
layout(std430) buffer a_list { float list[]; };
layout(std430) buffer a_other { float other[]; };
layout(std140) uniform Frame { vec4 frame; };
uniform vec3 tint;
void main() { imageStore(a_image, ivec2(0), texelFetch(a_one, ivec2(0), 0) + vec4(texelFetch(a_two, ivec3(0), 0)) + vec4(tint, 0) + frame);
  list[0] = other[0]; }
)");
    Program program("x", {"x.comp"}, folder.path());
    program.scan({}, {});
    ASSERT_TRUE(program.build({})) << program.errors()[0].text();
    const ProgramInterface& interface = program.interface();
    ASSERT_EQ(interface.samplers.size(), 2u);
    EXPECT_NE(interface.samplers[0].unit, interface.samplers[1].unit);
    for (const OpaqueInfo& sampler : interface.samplers) {
        GLint unit = -1;
        glGetUniformiv(program.id(), glGetUniformLocation(program.id(), sampler.name.c_str()), &unit);
        EXPECT_EQ(unit, sampler.unit) << sampler.name;
    }
    ASSERT_EQ(interface.images.size(), 1u);
    ASSERT_EQ(interface.storage_blocks.size(), 2u);
    EXPECT_NE(interface.storage_blocks[0].binding, interface.storage_blocks[1].binding);
    ASSERT_EQ(interface.uniforms.size(), 1u);
    EXPECT_EQ(interface.uniforms[0].name, "tint");
    EXPECT_TRUE(set_uniform(program.id(), interface.uniforms[0], glm::vec3(1, 2, 3)));
    float value[3] = {};
    glGetUniformfv(program.id(), interface.uniforms[0].location, value);
    EXPECT_EQ(value[2], 3);
    EXPECT_FALSE(set_uniform(program.id(), interface.uniforms[0], 1.0f));
}

TEST(Uniforms, TakeValuesOfTheirType) {
    EXPECT_TRUE(uniform_takes(GL_INT, ParameterValue(true)));
    EXPECT_TRUE(uniform_takes(GL_UNSIGNED_INT, ParameterValue(3)));
    EXPECT_TRUE(uniform_takes(GL_FLOAT, ParameterValue(3)));
    EXPECT_FALSE(uniform_takes(GL_INT, ParameterValue(0.5f)));
    EXPECT_FALSE(uniform_takes(GL_FLOAT_VEC2, ParameterValue(glm::vec3(1))));
    EXPECT_FALSE(uniform_takes(GL_FLOAT_MAT4, ParameterValue(1.0f)));
}
