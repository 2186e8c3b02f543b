// Graphs that run: what their passes compute is checked against the same worked out on the CPU.
#include "graph/graph_test.h"

using namespace bounce;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Running = GraphTest;

TEST_F(Running, AScriptPassNeedsNoCode) {
    fill_shader("uv.comp", "a_uv", "p.x, p.y, resolution.x, frame_index",
                "uniform vec2 resolution;\nuniform int frame_index;");
    GraphRunner run(graph_file(
        R"("resources":{"a.uv":{"format":"rgba32f","size":[5,3]}},"passes":[{"id":"uv","type":"compute","shader":"uv.comp"}])"));
    run.frame(3);
    EXPECT_EQ(run.problems(), "");
    std::vector<float> texels = run.read("a.uv");
    ASSERT_EQ(texels.size(), 5u * 3 * 4);
    for (int i = 0; i < 15; ++i)
        EXPECT_THAT(std::vector<float>(&texels[4 * size_t(i)], &texels[4 * size_t(i)] + 4),
                    ElementsAre(i % 5, i / 5, 16, 2));
}

/// A mip chain from one shader: each level is bound to the one above and its own. Non-power-of-two, so that a level's
/// size matters; and each step must see what the last one stored.
TEST_F(Running, RepeatsOverMipsBuildAChain) {
    fill_shader("fill.comp", "a_chain", "float((p.x * 7 + p.y * 13) % 32)");
    fill_shader(
        "down.comp", "a_to",
        "texelFetch(a_from, 2 * p, 0).r + 0.5 * texelFetch(a_from, min(2 * p + 1, textureSize(a_from, 0) - 1), 0).r",
        "uniform sampler2D a_from;");
    GraphRunner run(graph_file(R"("resources":{"a.chain":{"format":"r32f","size":[37,18],"mips":"full"}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp","dispatch":"a.chain"},
                  {"id":"down","type":"compute","shader":"down.comp","dispatch":"a.chain",
                   "bind":{"a.from":{"resource":"a.chain","mip":"iteration - 1"},"a.to":{"resource":"a.chain","mip":"iteration"}},
                   "repeat":{"over":"mips","of":"a.chain","from":1}}])"));
    run.frame(2);
    EXPECT_EQ(run.problems(), "");
    const PlanPass& down = run.pass("down");
    EXPECT_EQ(down.repeat_from, 1);
    EXPECT_EQ(down.repeat_to, 6);
    EXPECT_EQ(down.step_barriers, GLbitfield(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT));

    glm::ivec2 size(37, 18);
    std::vector<float> level;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            level.push_back(float((x * 7 + y * 13) % 32));
    for (int mip = 0; mip < 6; ++mip) {
        EXPECT_EQ(run.read("a.chain", mip), level) << "mip " << mip;
        glm::ivec2 next = glm::max(size / 2, glm::ivec2(1));
        std::vector<float> below;
        for (int y = 0; y < next.y; ++y) {
            for (int x = 0; x < next.x; ++x) {
                glm::ivec2 other = glm::min(2 * glm::ivec2(x, y) + 1, size - 1);
                below.push_back(level[size_t(2 * y * size.x + 2 * x)] +
                                0.5f * level[size_t(other.y * size.x + other.x)]);
            }
        }
        level = below;
        size = next;
    }
}

TEST_F(Running, RepeatsOverLayersFillOneAtATime) {
    fill_shader("layer.comp", "a_layer", "iteration * 10 + p.x", "uniform int iteration;");
    GraphRunner run(graph_file(R"("resources":{"a.stack":{"kind":"texture_2d_array","format":"r32f","size":[3,1,4]}},
        "passes":[{"id":"layer","type":"compute","shader":"layer.comp","bind":{"a.layer":{"resource":"a.stack","layer":"iteration"}},
                   "repeat":{"over":"layers","of":"a.stack"}}])"));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_THAT(run.read("a.stack"), ElementsAre(0, 1, 2, 10, 11, 12, 20, 21, 22, 30, 31, 32));
}

TEST_F(Running, StepsOfARepeatedPassSeeEachOther) {
    shader(
        "add.comp",
        "layout(local_size_x = 1) in;\nlayout(std430) buffer list_sums { uint sums[]; };\nuniform int iteration;\n"
        "void main() { uint i = gl_GlobalInvocationID.x; sums[i] = sums[(i + 1u) % 64u] * 3u + uint(iteration); }\n");
    shader("copy.comp", "layout(local_size_x = 1) in;\nlayout(std430) readonly buffer list_sums { uint sums[]; };\n"
                        "layout(std430) writeonly buffer list_copy { uint copied[]; };\n"
                        "void main() { uint i = gl_GlobalInvocationID.x; copied[i] = sums[i]; }\n");
    GraphRunner run(graph_file(
        R"("resources":{"list.sums":{"kind":"buffer","count":64,"stride":4},"list.copy":{"kind":"buffer","count":"list.sums.count","stride":4}},
        "passes":[{"id":"add","type":"compute","shader":"add.comp","dispatch":[1],"repeat":8},
                  {"id":"copy","type":"compute","shader":"copy.comp","dispatch":["list.sums.count"]}])"));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.pass("add").step_barriers, GLbitfield(GL_SHADER_STORAGE_BARRIER_BIT));
    EXPECT_EQ(run.pass("copy").barriers, GLbitfield(GL_SHADER_STORAGE_BARRIER_BIT));
    EXPECT_THAT(plan_text(run.graph.model(), run.graph.plan()), HasSubstr("between steps shader_storage"));
    std::vector<uint32_t> sums(64, 0);
    for (uint32_t step = 0; step < 8; ++step)
        sums[0] = sums[1] * 3 + step; // one invocation
    EXPECT_EQ(run.read_buffer<uint32_t>("list.copy"), sums);
}

TEST_F(Running, PreviousIsLastFramesCopyUntilHistoryIsVoid) {
    fill_shader("count.comp", "a_count", "texelFetch(a_before, p, 0).r + 1.0", "uniform sampler2D a_before;");
    GraphRunner run(graph_file(
        R"-("resources":{"a.count":{"format":"r32f"}},"passes":[{"id":"count","type":"compute","shader":"count.comp",
                               "bind":{"a.before":"previous(a.count)"}}])-"));
    run.frame();
    EXPECT_THAT(run.read("a.count"), Each(1));
    run.frame(4);
    EXPECT_THAT(run.read("a.count"), Each(5));
    run.graph.reset_history(); // a camera cut
    run.frame();
    EXPECT_THAT(run.read("a.count"), Each(1));
    run.frame();
    run.size = {20, 10};
    run.frame();
    EXPECT_THAT(run.read("a.count"), Each(1)) << "resized";
    EXPECT_EQ(run.read("a.count").size(), 200u);
}

TEST_F(Running, PreviousOfABufferToo) {
    shader("count.comp",
           "layout(local_size_x = 1) in;\nlayout(std430) readonly buffer list_before { uint before[]; };\n"
           "layout(std430) writeonly buffer list_now { uint now[]; };\nvoid main() { now[0] = before[0] + 2u; }\n");
    GraphRunner run(graph_file(R"-("resources":{"list.now":{"kind":"buffer","count":1,"stride":4}},
        "passes":[{"id":"count","type":"compute","shader":"count.comp","dispatch":[1],"bind":{"list.before":"previous(list.now)"}}])-"));
    run.frame(3);
    EXPECT_THAT(run.read_buffer<uint32_t>("list.now"), ElementsAre(6));
}

TEST_F(Running, PersistentResourcesLastAndOthersAreCleared) {
    shader("add.comp",
           "layout(local_size_x = 1) in;\nlayout(FORMAT_a_kept) uniform uimage2D a_kept;\nlayout(FORMAT_a_fresh) "
           "uniform uimage2D a_fresh;\n"
           "void main() { imageAtomicAdd(a_kept, ivec2(0), 1u); imageAtomicAdd(a_fresh, ivec2(0), 1u); }\n");
    GraphRunner run(graph_file(
        R"("resources":{"a.kept":{"format":"r32ui","size":[1,1],"persistent":true},"a.fresh":{"format":"r32ui","size":[1,1],"neutral":7}},
        "passes":[{"id":"add","type":"compute","shader":"add.comp","dispatch":[3]}])"));
    run.frame(4);
    EXPECT_EQ(run.problems(), "");
    EXPECT_THAT(run.read("a.kept"), ElementsAre(12));
    EXPECT_THAT(run.read("a.fresh"), ElementsAre(10));
    run.graph.reset_history();
    run.frame();
    EXPECT_THAT(run.read("a.kept"), ElementsAre(3));
}

TEST_F(Running, DispatchesByCountsFromABuffer) {
    shader("counts.comp", "layout(local_size_x = 1) in;\nlayout(std430) buffer list_groups { uint groups[]; };\n"
                          "void main() { groups[0] = 5u; groups[1] = 2u; groups[2] = 1u; }\n");
    shader("many.comp", "layout(local_size_x = 4) in;\nlayout(std430) buffer list_hits { uint hits; };\nvoid main() { "
                        "atomicAdd(hits, 1u); }\n");
    GraphRunner run(
        graph_file(R"("resources":{"list.groups":{"kind":"buffer","count":3},"list.hits":{"kind":"buffer","count":1}},
        "passes":[{"id":"many","type":"compute","shader":"many.comp","dispatch":{"indirect":"list.groups"}},
                  {"id":"counts","type":"compute","shader":"counts.comp","dispatch":[1]}])"));
    run.frame(2);
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.graph.plan().passes[0].id, "counts");
    EXPECT_TRUE(run.pass("many").barriers & GL_COMMAND_BARRIER_BIT);
    EXPECT_THAT(run.read_buffer<uint32_t>("list.hits"), ElementsAre(40));
}

TEST_F(Running, FormatsOfImagesComeFromTheResource) {
    fill_shader("fill.comp", "a_image", "0.3333");
    for (auto [format, expected] : {std::pair{"r32f", 0.3333f}, {"r8", 85 / 255.0f}, {"r16f", 0.33325195f}}) {
        GraphRunner run(graph_file(std::string(R"("resources":{"a.image":{"format":")") + format + R"(","size":[2,2]}},
                                    "passes":[{"id":"fill","type":"compute","shader":"fill.comp"}])"));
        run.frame();
        EXPECT_EQ(run.problems(), "") << format;
        EXPECT_THAT(run.graph.model().nodes()[0]->programs[0]->sources()[0].text,
                    HasSubstr(std::string("#define FORMAT_a_image ") + format));
        EXPECT_THAT(run.read("a.image"), Each(expected)) << format;
    }
}

TEST_F(Running, SlotsAreBoundToOtherResources) {
    fill_shader("fill.comp", "any_target", "1.0 + texelFetch(any_source, p, 0).r",
                "uniform sampler2D any_source; //! optional");
    GraphRunner run(graph_file(R"("resources":{"a.one":{"format":"r32f"},"a.two":{"format":"r32f"}},
        "passes":[{"id":"second","type":"compute","shader":"fill.comp","bind":{"any.source":"a.one","any.target":"a.two"}},
                  {"id":"first","type":"compute","shader":"fill.comp","bind":{"any.target":"a.one"}}])"));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_THAT(run.read("a.one"), Each(1));
    EXPECT_THAT(run.read("a.two"), Each(2));
}

/// The consumer of a skipped pass reads the neutral value at every texel, by fetch as by filter.
TEST_F(Running, ConsumersOfADeclinedPassReadItsNeutralValue) {
    fill_shader("ao.comp", "a_occlusion", "0.25");
    fill_shader("use.comp", "out_display",
                "texelFetch(a_occlusion, p, 0).r, texture(a_occlusion, (vec2(p) + 0.5) / vec2(16.0, 8.0)).r, 0, 0",
                "uniform sampler2D a_occlusion;");
    GraphRunner run(
        graph_file(R"("resources":{"a.occlusion":{"format":"r16f","neutral":1},"out.display":{"format":"rgba32f"}},
        "passes":[{"id":"ao","type":"compute","shader":"ao.comp","needs":"emissive_materials"},{"id":"use","type":"compute","shader":"use.comp"}])"));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    std::vector<float> texels = run.read("out.display");
    for (size_t i = 0; i < texels.size(); i += 4) {
        ASSERT_EQ(texels[i], 1) << "fetched at texel " << i / 4;
        ASSERT_EQ(texels[i + 1], 1) << "filtered at texel " << i / 4;
    }
    run.facts.emissive_materials = 1;
    run.frame();
    EXPECT_EQ(run.read("out.display")[0], 0.25f);
}

TEST_F(Running, ThePlansBytesAreThoseOfTheObjects) {
    fill_shader("fill.comp", "a_image", "1");
    shader("list.comp", "layout(local_size_x = 1) in;\nlayout(std430) buffer list_nodes { uvec3 nodes[]; };\nvoid "
                        "main() { nodes[0] = uvec3(1); }\n");
    GraphRunner run(graph_file(
        R"("resources":{"a.image":{"format":"rg16f","size":[33,17],"mips":"full"},"list.nodes":{"kind":"buffer","count":7,"stride":16}},
        "passes":[{"id":"fill","type":"compute","shader":"fill.comp"},{"id":"list","type":"compute","shader":"list.comp","dispatch":[1]}])"));
    run.frame();
    for (const PlanResource& resource : run.graph.plan().resources) {
        uint64_t real = 0;
        if (resource.is_buffer()) {
            GLint64 bytes = 0;
            glGetNamedBufferParameteri64v(run.graph.buffer(resource.name())->id(), GL_BUFFER_SIZE, &bytes);
            real = uint64_t(bytes);
        } else {
            GLuint id = run.graph.texture(resource.name())->id();
            GLint levels = 0;
            glGetTextureParameteriv(id, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
            for (GLint level = 0; level < levels; ++level) {
                GLint side[3] = {}, bits[4] = {};
                const GLenum sides[] = {GL_TEXTURE_WIDTH, GL_TEXTURE_HEIGHT, GL_TEXTURE_DEPTH};
                const GLenum sizes[] = {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                                        GL_TEXTURE_ALPHA_SIZE};
                for (int i = 0; i < 3; ++i)
                    glGetTextureLevelParameteriv(id, level, sides[i], &side[i]);
                for (int i = 0; i < 4; ++i)
                    glGetTextureLevelParameteriv(id, level, sizes[i], &bits[i]);
                real += uint64_t(side[0]) * uint64_t(side[1]) * uint64_t(side[2]) *
                        uint64_t(bits[0] + bits[1] + bits[2] + bits[3]) / 8;
            }
        }
        EXPECT_EQ(resource.bytes, real) << resource.name();
    }
}

TEST_F(Running, APlantedNanIsFoundAndNamed) {
    fill_shader("fill.comp", "a_image", "p == ivec2(3, 2) ? vec4(sqrt(zero - 1.0), 1.0 / zero, 0, 1) : vec4(1)",
                "uniform float zero = 0.0; //! [0, 1] none");
    fill_shader("clean.comp", "a_clean", "2");
    GraphRunner run(graph_file(
        R"("resources":{"a.image":{},"a.clean":{}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                               {"id":"clean","type":"compute","shader":"clean.comp"}])"));
    root.write("glsl/graph/nan_check.comp", [] {
        std::ifstream file(real_root() / "glsl/graph/nan_check.comp");
        return std::string(std::istreambuf_iterator<char>(file), {});
    }());
    run.graph.check_nan = true;
    run.frame();
    EXPECT_EQ(run.graph.non_finite(), (std::map<std::string, uint64_t>{{"a.image", 2}}));
    run.graph.model().set("fill.zero", "1", ParameterOrigin::panel);
    run.frame();
    EXPECT_TRUE(run.graph.non_finite().empty());
}

TEST_F(Running, SwitchingAPassOffDropsItAtTheNextFrame) {
    fill_shader("fill.comp", "a_image", "1");
    fill_shader("use.comp", "out_display", "texelFetch(a_image, ivec2(0), 0).r", "uniform sampler2D a_image;");
    GraphRunner run(graph_file(
        R"("resources":{"a.image":{},"out.display":{"format":"r32f"}},"passes":[{"id":"fill","type":"compute","shader":"fill.comp"},
                               {"id":"use","type":"compute","shader":"use.comp"}])"));
    run.frame();
    EXPECT_EQ(run.read("out.display")[0], 1);
    run.graph.model().find_node("fill")->enabled = false;
    run.graph.touch();
    run.frame();
    EXPECT_EQ(run.read("out.display")[0], 0);
    EXPECT_EQ(run.graph.texture("a.image"), nullptr);
}
