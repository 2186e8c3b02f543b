// The rules of memory barriers (OpenGL 4.6, section 7.13.2), by commands that are made up. No OpenGL.
#include "gpu/hazard_check.h"
#include "gpu/shader_memory.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

constexpr MemoryRoute k_routes[] = {
    MemoryRoute::sampler,          MemoryRoute::image,          MemoryRoute::storage,  MemoryRoute::uniform,
    MemoryRoute::vertices,         MemoryRoute::indices,        MemoryRoute::indirect, MemoryRoute::framebuffer,
    MemoryRoute::texture_transfer, MemoryRoute::buffer_transfer};

MemoryUse use(MemoryRoute route, bool reads, bool writes, MemoryRange range = {7}) {
    return {range, route, reads, writes, ""};
}

std::vector<std::string> found(const std::vector<std::pair<MemoryUse, GLbitfield>>& uses_and_barriers_after) {
    HazardCheck check;
    for (const auto& [each, bits] : uses_and_barriers_after) {
        check.command({"command", {each}});
        if (bits) check.barrier(bits, "barrier");
    }
    return check.hazards();
}

} // namespace

TEST(HazardCheck, WhatFollowsAStoreNeedsTheBitOfItsOwnRoute) {
    for (MemoryRoute store : {MemoryRoute::image, MemoryRoute::storage}) {
        for (MemoryRoute later : k_routes) {
            const MemoryUse after = use(later, true, false);
            EXPECT_EQ(found({{use(store, false, true), 0}, {after, 0}}).size(), 1u) << to_string(later);
            EXPECT_THAT(found({{use(store, false, true), barrier_bit(later)}, {after, 0}}), IsEmpty());
            EXPECT_EQ(found({{use(store, false, true), GL_ALL_BARRIER_BITS & ~barrier_bit(later)}, {after, 0}}).size(),
                      1u)
                << to_string(later) << ": the bits of other routes do not help";
        }
    }
}

TEST(HazardCheck, WhatOpenGlOrdersItselfNeedsNone) {
    for (MemoryRoute writer : {MemoryRoute::framebuffer, MemoryRoute::texture_transfer, MemoryRoute::buffer_transfer})
        for (MemoryRoute later : k_routes)
            EXPECT_THAT(found({{use(writer, false, true), 0}, {use(later, true, false), 0}}), IsEmpty());
    for (MemoryRoute later : k_routes)
        EXPECT_THAT(found({{use(MemoryRoute::image, true, false), 0}, {use(later, true, false), 0}}), IsEmpty())
            << "two reads";
}

TEST(HazardCheck, AStoreWaitsForReadsByItsOwnBit) {
    const MemoryUse read = use(MemoryRoute::sampler, true, false), store = use(MemoryRoute::image, false, true);
    EXPECT_EQ(found({{read, 0}, {store, 0}}).size(), 1u);
    EXPECT_EQ(found({{read, GL_TEXTURE_FETCH_BARRIER_BIT}, {store, 0}}).size(), 1u) << "the reader's bit";
    EXPECT_THAT(found({{read, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT}, {store, 0}}), IsEmpty());
    EXPECT_THAT(found({{read, 0}, {use(MemoryRoute::framebuffer, true, true), 0}}), IsEmpty());
    EXPECT_THAT(found({{use(MemoryRoute::texture_transfer, true, false), 0}, {store, 0}}), IsEmpty());
}

TEST(HazardCheck, OtherMemoryIsNotConcerned) {
    const MemoryRange mip_1{7, false, 1, 2, 0, 4}, mip_2{7, false, 2, 3, 0, 4}, layer_3{7, false, 1, 2, 3, 4};
    EXPECT_THAT(
        found({{use(MemoryRoute::image, false, true, mip_1), 0}, {use(MemoryRoute::sampler, true, false, mip_2), 0}}),
        IsEmpty());
    EXPECT_EQ(
        found({{use(MemoryRoute::image, false, true, mip_1), 0}, {use(MemoryRoute::sampler, true, false, layer_3), 0}})
            .size(),
        1u);
    const MemoryRange buffer{7, true, 0, 1, 0, 4};
    EXPECT_THAT(
        found({{use(MemoryRoute::image, false, true, mip_1), 0}, {use(MemoryRoute::storage, true, false, buffer), 0}}),
        IsEmpty())
        << "a buffer of the same number";
    HazardCheck check;
    check.command({"a", {use(MemoryRoute::image, false, true)}});
    check.forget(7, false);
    check.command({"b", {use(MemoryRoute::sampler, true, false)}});
    EXPECT_THAT(check.hazards(), IsEmpty()) << "a new texture of the same number";
}

TEST(HazardCheck, OneCommandMustNotTouchByTwoBindingsWhatItWrites) {
    HazardCheck check;
    check.command({"pass 'x'", {use(MemoryRoute::image, false, true), use(MemoryRoute::sampler, true, false)}});
    EXPECT_THAT(check.hazards(),
                ElementsAre(AllOf(HasSubstr("pass 'x'"), HasSubstr("texture 7"), HasSubstr("sampler"))));
    HazardCheck reads;
    reads.command({"x", {use(MemoryRoute::image, true, false), use(MemoryRoute::sampler, true, false)}});
    reads.command({"y",
                   {use(MemoryRoute::image, false, true, {7, false, 1, 2}),
                    use(MemoryRoute::sampler, true, false, {7, false, 0, 1})}});
    EXPECT_THAT(reads.hazards(), IsEmpty()) << "two reads; and a mip that is made from the finer one";
}

TEST(HazardCheck, MessagesNameBothSidesAndTheBit) {
    HazardCheck check;
    check.describe = [](const MemoryRange&) { return "'a.b'"; };
    check.command({"pass 'one'", {{{7}, MemoryRoute::image, false, true, "a_b"}}});
    check.command({"pass 'two'", {{{7}, MemoryRoute::sampler, true, false, "a_c"}}});
    EXPECT_THAT(check.hazards(),
                ElementsAre("pass 'two' reads 'a.b' by sampler 'a_c' after pass 'one' by image 'a_b' wrote it: "
                            "GL_TEXTURE_FETCH_BARRIER_BIT is missing between them"));
}

TEST(HazardCheck, TellsWhichBarriersWereNeeded) {
    HazardCheck check;
    check.command({"a", {use(MemoryRoute::image, false, true)}});
    check.barrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT, "first");
    check.barrier(GL_TEXTURE_FETCH_BARRIER_BIT, "second");
    check.barrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, "third");
    check.command({"b", {use(MemoryRoute::sampler, true, false)}});
    check.command({"c", {use(MemoryRoute::image, false, true)}});
    ASSERT_EQ(check.barriers().size(), 3u);
    EXPECT_EQ(check.barriers()[0].used, GLbitfield(GL_TEXTURE_FETCH_BARRIER_BIT));
    EXPECT_EQ(check.barriers()[0].needed, 0u) << "the second gives it as well";
    EXPECT_EQ(check.barriers()[1].used, 0u);
    EXPECT_EQ(check.barriers()[2].needed, GLbitfield(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT));
    EXPECT_THAT(check.hazards(), ElementsAre(HasSubstr("overwrites"))) << "c, of what b read";
    EXPECT_EQ(check.barrier_report(), "3 memory barriers at 3 places, 2 of which no command needed: first; second");
}

TEST(ShaderMemory, WhatDeclarationsSay) {
    const auto found = read_shader_memory("#version 460 core\n"
                                          "#define FORMAT_a rgba16f\n"
                                          "layout(FORMAT_a) writeonly uniform image2D a_out, a_more[2];\n"
                                          "layout(r32ui) coherent uniform uimage3D a_counts;\n"
                                          "// layout(r8) uniform image2D a_comment;\n"
                                          "#if 0\nlayout(r8) uniform image2D a_off;\n#endif\n"
                                          "uniform sampler2D a_in;\n"
                                          "layout(std430) readonly buffer a_list { uint items[]; };\n"
                                          "layout(std430) buffer a_both { uint more[]; } named;\n"
                                          "void main() { items[0]; }\n");
    ASSERT_EQ(found.size(), 5u);
    EXPECT_FALSE(found.at("a_out").reads);
    EXPECT_EQ(found.at("a_more").format, GLenum(GL_RGBA16F));
    EXPECT_TRUE(found.at("a_counts").reads && found.at("a_counts").writes && found.at("a_counts").coherent);
    EXPECT_EQ(found.at("a_counts").format, GLenum(GL_R32UI));
    EXPECT_FALSE(found.at("a_list").writes);
    EXPECT_TRUE(found.at("a_both").reads && found.at("a_both").writes);
}
