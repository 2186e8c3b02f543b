// What shaders say of the order of their invocations (OpenGL 4.6, section 7.13.1), by texts that are made up. No
// OpenGL.
#include "gpu/shader_order.h"

#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

std::vector<std::string> problems_of(const std::string& declarations, const std::string& body) {
    TempFolder folder;
    folder.write("a.comp",
                 declarations +
                     "\nlayout(local_size_x = 8) in;\nvoid main() {\n    uint i = gl_GlobalInvocationID.x;\n" + body +
                     "\n}\n");
    const ShaderSource source = expand_shader(folder.path() / "a.comp", folder.path(), {}, {});
    EXPECT_TRUE(source.errors.empty()) << source.errors.front().text();
    return order_problems(source);
}

} // namespace

TEST(ShaderOrder, WhatIsOnlyReadOrOnlyWrittenSaysSo) {
    const std::string image = "layout(r32f) uniform image2D a_b;", block = "layout(std430) buffer a_c { uint c[]; };";
    EXPECT_THAT(problems_of(image, "    imageStore(a_b, ivec2(i), vec4(1.0));"),
                ElementsAre(AllOf(HasSubstr("a.comp:1"), HasSubstr("'a_b'"), HasSubstr("writeonly"))));
    EXPECT_THAT(problems_of(image, "    if (imageLoad(a_b, ivec2(i)).r == 1.0) return;"),
                ElementsAre(HasSubstr("readonly")));
    EXPECT_THAT(problems_of(block, "    c[i] = 1u;"), ElementsAre(HasSubstr("writeonly")));
    EXPECT_THAT(problems_of(block, "    if (c[i] <= 1u) return;"), ElementsAre(HasSubstr("readonly")));
    EXPECT_THAT(problems_of("layout(std430) writeonly buffer a_c { uint c[]; };", "    c[i] = 1u;"), IsEmpty());
    EXPECT_THAT(problems_of("layout(std430) buffer a_c { uint c[]; } e;", "    e.c[i] = 1u;"),
                ElementsAre(HasSubstr("writeonly")));
}

TEST(ShaderOrder, WhatIsReadAndWrittenNeedsAnOrderOrAnArgument) {
    const std::string block = "layout(std430) buffer a_c { uint d, c[]; };";
    for (const char* body :
         {"    c[i] = c[i + 1u];", "    c[i].x += 1u;", "    ++c[i];", "    c[i]--;", "    c[i] <<= 1u;",
          "    c[i] = 1u;\n    atomicAdd(d, 1u);", "    if (atomicAdd(d, 1u) < c[i]) return;"})
        EXPECT_THAT(problems_of(block, body), ElementsAre(HasSubstr("nothing orders"))) << body;
    EXPECT_THAT(problems_of(block, "    atomicAdd(d, 1u);\n    atomicMax(c[i], 2u);"), IsEmpty())
        << "atomics are ordered";
    EXPECT_THAT(problems_of("layout(std430) buffer a_c { uint c[]; }; //! ordered: each, as said, has its own",
                            "    c[i] += 1u;"),
                IsEmpty());
    EXPECT_THAT(problems_of("layout(r32ui) uniform uimage2D a_b; //! optional, ordered: each has its own",
                            "    imageStore(a_b, ivec2(i), imageLoad(a_b, ivec2(i)) + 1u);"),
                IsEmpty());
}

TEST(ShaderOrder, CoherentMemoryNeedsTheBarrierToo) {
    const std::string block = "layout(std430) coherent buffer a_c { uint c[]; };";
    EXPECT_THAT(problems_of(block, "    c[i] = 1u;\n    if (c[i + 1u] == 1u) return;"),
                ElementsAre(HasSubstr("memoryBarrier")));
    EXPECT_THAT(problems_of(block, "    c[i] = 1u;\n    groupMemoryBarrier();\n    if (c[i + 1u] == 1u) return;"),
                ElementsAre(HasSubstr("memoryBarrier")))
        << "it orders a work group alone";
    EXPECT_THAT(problems_of(block, "    c[i] = 1u;\n    memoryBarrierBuffer();\n    if (c[i + 1u] == 1u) return;"),
                IsEmpty());
}

TEST(ShaderOrder, AMemberOfAnotherThingIsNoAccess) {
    EXPECT_THAT(problems_of("struct S { uint c; };\nlayout(std430) readonly buffer a_c { uint c[]; };",
                            "    S s;\n    s.c = c[i];"),
                IsEmpty());
    EXPECT_THAT(problems_of("layout(std430) writeonly buffer a_c { uint c[]; };", "    c[i] = uint(c.length());"),
                IsEmpty());
}

TEST(ShaderOrder, ANoteWithoutAReasonIsRefused) {
    TempFolder folder;
    folder.write("a.comp", "layout(std430) buffer a_c { uint c[]; }; //! ordered\nvoid main() {}\n");
    const ShaderSource source = expand_shader(folder.path() / "a.comp", folder.path(), {}, {});
    ASSERT_EQ(source.errors.size(), 1u);
    EXPECT_THAT(source.errors[0].text(), HasSubstr("ordered: REASON"));
}
