// A graph that goes beyond a limit of the driver is told before anything is allocated or compiled: pass, need, limit,
// and what lowers it.
#include "gpu/driver_limits.h"
#include "gpu/objects.h"
#include "graph/graph_test.h"
#include "graph/plan_needs.h"
#include "support/fake_driver.h"

#include <fmt/format.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

const char* const k_image = R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]}},)";

std::string passes(const std::string& more = "") {
    return R"("passes":[{"id":"fill","type":"compute","shader":"fill.comp")" + more + "}]";
}

} // namespace

class Limits : public GraphTest {
  protected:
    void TearDown() override {
        pretend_limits("");
        GpuTest::TearDown();
    }
    /// What is told of a graph of one pass, which allocates and compiles nothing then.
    std::string refusal(const std::string& members) {
        const std::filesystem::path file = graph_file(members);
        std::string text;
        {
            GraphRunner run(file);
            const LiveObjects before = live_objects();
            text = error_of([&] { run.frame(); });
            EXPECT_EQ(live_objects().total(), before.total()) << "allocated or compiled: " << text;
        }
        return text;
    }
    /// `count` samplers that all read the scene's white texture, an expression that uses `used` of them.
    static std::string samplers(int count) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += fmt::format("uniform sampler2D b_{0}; //! optional\n", i);
        return text;
    }
    static std::string sum(int count, const std::string& first = "0.0") {
        std::string text = first;
        for (int i = 0; i < count; ++i)
            text += fmt::format(" + texelFetch(b_{}, p, 0).x", i);
        return text;
    }
};

TEST_F(Limits, SamplersAndWhatLowersThem) {
    pretend_limits("minimum");
    fill_shader("fill.comp", "a_image", sum(17), samplers(17));
    EXPECT_THAT(
        refusal(std::string(k_image) + passes()),
        AllOf(HasSubstr("graph 'g'"), HasSubstr("pass 'fill' (fill.comp) needs 17 samplers in a compute shader"),
              HasSubstr("allows 16 (GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS)"), HasSubstr("no parameter lowers it")));
    // Behind a switch that is compiled in.
    fill_shader("fill.comp", "a_image", "many ? " + sum(0) + " : 0.0", samplers(17));
    shader("fill.comp", "layout(local_size_x = 8) in;\n" + samplers(17) +
                            "uniform bool many = true; //! static all of them\n"
                            "layout(FORMAT_a_image) writeonly uniform image2D a_image;\nvoid main() {\n  ivec2 p = "
                            "ivec2(gl_GlobalInvocationID.xy);\n  float x = texelFetch(b_0, p, 0).x;\n  if (many) x = " +
                            sum(17) + ";\n  imageStore(a_image, p, vec4(x));\n}\n");
    EXPECT_THAT(refusal(std::string(k_image) + passes()),
                AllOf(HasSubstr("needs 17 samplers"), HasSubstr("set fill.many=false: it would need 1")));
    pretend_limits("");
    GraphRunner run(graph_file(std::string(k_image) + passes()));
    if (driver_limit(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS) >= 17) run.frame();
    EXPECT_EQ(run.problems(), "");
}

TEST_F(Limits, SharedMemoryAndWorkGroups) {
    pretend_limits("minimum");
    shader("fill.comp", "uniform int side = 128; //! static [1, 128] of the tile\n"
                        "layout(local_size_x = 8) in;\nshared float tile[side * side];\n"
                        "layout(FORMAT_a_image) writeonly uniform image2D a_image;\nvoid main() {\n  "
                        "tile[gl_LocalInvocationIndex] = 1.0;\n  barrier();\n  imageStore(a_image, ivec2(0), "
                        "vec4(tile[0]));\n}\n");
    EXPECT_THAT(refusal(std::string(k_image) + passes()),
                AllOf(HasSubstr("needs 65,536 bytes of shared memory"), HasSubstr("allows 32,768"),
                      HasSubstr("lower fill.side (128): half of it would need 16,384")));
    shader("fill.comp", "layout(local_size_x = 32, local_size_y = 2, local_size_z = 32) in;\n"
                        "layout(FORMAT_a_image) writeonly uniform image2D a_image;\nvoid main() {\n  "
                        "imageStore(a_image, ivec2(0), vec4(1));\n}\n");
    EXPECT_THAT(refusal(std::string(k_image) + passes()),
                AllOf(HasSubstr("needs 2,048 invocations in a work group"), HasSubstr("allows 1,024")));
}

TEST_F(Limits, ImagesStorageBlocksAndTheirSum) {
    pretend_limits("minimum");
    std::string slots, uses, resources;
    for (int i = 0; i < 5; ++i) {
        slots +=
            fmt::format("layout(FORMAT_c_{0}) writeonly uniform image2D c_{0};\nlayout(std430) buffer d_{0} {{ uint "
                        "list_{0}[]; }};\n",
                        i);
        uses += fmt::format("  imageStore(c_{0}, ivec2(0), vec4(1));\n  list_{0}[0] = 1u;\n", i);
        resources +=
            fmt::format(R"("c.{0}":{{"format":"rgba16f","size":[4,4]}},"d.{0}":{{"kind":"buffer","count":4}}{1})", i,
                        i < 4 ? "," : "");
    }
    shader("fill.comp", "layout(local_size_x = 1) in;\n" + slots + "void main() {\n" + uses + "}\n");
    const std::string text = R"("resources":{)" + resources + "}," + passes(R"(,"dispatch":[1,1,1])");
    EXPECT_THAT(refusal(text), AllOf(HasSubstr("needs 10 images, storage blocks and colours together"),
                                     HasSubstr("GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES")));
    pretend_limits("GL_MAX_IMAGE_UNITS=4,GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS=4");
    EXPECT_THAT(refusal(text),
                AllOf(HasSubstr("needs 5 image units"), HasSubstr("needs 5 storage blocks in a compute shader"),
                      Not(HasSubstr("together"))));
}

TEST_F(Limits, SizesOfBuffersAndTextures) {
    pretend_limits("GL_MAX_SHADER_STORAGE_BLOCK_SIZE=1000,GL_MAX_ARRAY_TEXTURE_LAYERS=20,GL_MAX_3D_TEXTURE_SIZE=32");
    fill_shader("fill.comp", "a_image", "1", "layout(std430) buffer d_list { uint list[]; };\n");
    root.edit("glsl/fill.comp", "imageStore", "list[0] = 1u;\n  imageStore");
    const std::string parameters = R"("parameters":{"length":{"default":400,"range":[1,1000]}},)";
    EXPECT_THAT(refusal(parameters + R"("resources":{"a.image":{"format":"rgba32f","size":[4,4]},
        "d.list":{"kind":"buffer","count":"length","stride":4}},)" +
                        passes()),
                AllOf(HasSubstr("pass 'fill' needs 1,600 bytes of the buffer 'd.list'"), HasSubstr("allows 1,000"),
                      HasSubstr("lower graph.length (400): half of it would need 800")));
    const auto texture = [&](const std::string& kind, const std::string& image, const std::string& size) {
        shader("fill.comp", "layout(local_size_x = 1) in;\nlayout(FORMAT_a_image) writeonly uniform " + image +
                                " a_image;\nvoid main() { imageStore(a_image, ivec3(0), vec4(1)); }\n");
        return refusal(R"("resources":{"a.image":{"kind":")" + kind + R"(","format":"rgba16f","size":)" + size + "}}," +
                       passes());
    };
    EXPECT_THAT(texture("texture_2d_array", "image2DArray", "[4,4,40]"),
                AllOf(HasSubstr("needs 40 layers of 'a.image'"), HasSubstr("allows 20 (GL_MAX_ARRAY_TEXTURE_LAYERS)")));
    EXPECT_THAT(texture("texture_3d", "image3D", "[4,64,4]"),
                AllOf(HasSubstr("needs 64 texels of the height of 'a.image'"),
                      HasSubstr("allows 32 (GL_MAX_3D_TEXTURE_SIZE)")));
}

TEST_F(Limits, WorkGroupsThatAreTooMany) {
    fill_shader("fill.comp", "a_image", "1");
    pretend_limits("GL_MAX_COMPUTE_WORK_GROUP_COUNT=8");
    GraphRunner run(graph_file(std::string(k_image) + passes(R"(,"dispatch":[8,80,1])")));
    run.frame();
    EXPECT_THAT(run.problems(), AllOf(HasSubstr("10 work groups along y"), HasSubstr("allows 8")));
    pretend_limits("");
    run.frame();
    EXPECT_EQ(run.problems(), "");
}

/// The picture goes on with the last plan that fits.
TEST_F(Limits, TheLastGoodGraphStays) {
    pretend_limits("GL_MAX_TEXTURE_SIZE=64");
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(std::string(k_image) + passes()));
    run.frame();
    root.edit("assets/graphs/g.json", "[4,4]", "[65,4]");
    run.graph.poll_files();
    run.frame();
    EXPECT_THAT(run.problems(),
                AllOf(HasSubstr("pass 'fill' needs 65 texels of the width of 'a.image'"), HasSubstr("allows 64")));
    EXPECT_EQ(run.read("a.image"), std::vector<float>(64, 1));
    root.edit("assets/graphs/g.json", "[65,4]", "[64,4]");
    run.graph.poll_files();
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.read("a.image").size(), 4u * 64 * 4);
}

TEST_F(Limits, MemoryThatRunsOutKeepsTheLastGoodGraph) {
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(R"("parameters":{"side":{"default":4,"range":[1,1000]}},
        "resources":{"a.image":{"format":"rgba32f","size":["side",4]}},)" +
                               passes()));
    run.frame();
    static bool full = false;
    run.graph.model().set("graph.side", "100", ParameterOrigin::panel);
    {
        Fake storage(
            glad_glTextureStorage2D, +[](GLuint, GLsizei, GLenum, GLsizei, GLsizei) { full = true; });
        Fake errors(
            glad_glGetError, +[]() -> GLenum { return std::exchange(full, false) ? GL_OUT_OF_MEMORY : GL_NO_ERROR; });
        run.frame();
    }
    EXPECT_THAT(run.problems(), AllOf(HasSubstr("graph 'g' needs 6.2 KiB of memory"), HasSubstr("'a.image'"),
                                      HasSubstr("out of memory"), HasSubstr("lower graph.side (100)")));
    EXPECT_EQ(run.read("a.image"), std::vector<float>(64, 1)) << "the old one";
    run.graph.model().set("graph.side", "8", ParameterOrigin::panel);
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.read("a.image").size(), 8u * 4 * 4);
}

/// What a GPU has free is no limit: its driver can move what is not in use.
TEST_F(Limits, AGpuThatHasLessFreeIsAWarning) {
    fill_shader("fill.comp", "a_image", "1");
    GraphRunner run(graph_file(R"("parameters":{"side":{"default":100,"range":[1,1000]}},
        "resources":{"a.image":{"format":"rgba32f","size":["side",4]}},)" +
                               passes()));
    std::ostringstream told;
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(told);
    spdlog::default_logger()->sinks().push_back(sink);
    {
        FakeGpu gpu("GL_NVX_gpu_memory_info", 4);
        run.graph.prepare(run.facts, run.size);
    }
    spdlog::default_logger()->sinks().pop_back();
    EXPECT_THAT(told.str(),
                AllOf(HasSubstr("graph 'g' needs 6.2 KiB of memory"), HasSubstr("4.0 KiB are free on the GPU"),
                      HasSubstr("lower graph.side (100): half of it would need 3.1 KiB in all")));
    run.frame();
    EXPECT_EQ(run.problems(), "");
    EXPECT_EQ(run.read("a.image").size(), 100u * 4 * 4);
}
