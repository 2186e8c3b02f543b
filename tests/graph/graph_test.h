#pragma once
// A root with no shaders and graphs but those of the test.

#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/graph_runner.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

namespace bounce {

class GraphTest : public GpuTest {
  protected:
    /// Writes assets/graphs/g.json around the given members and returns its path.
    std::filesystem::path graph_file(const std::string& members) const {
        root.write("assets/graphs/g.json", "{\"version\": 1, " + members + "}");
        return root / "assets/graphs/g.json";
    }
    void shader(const std::string& name, const std::string& body) const { root.write("glsl/" + name, body); }
    /// A shader that fills a 2D image with an expression of `p`, its texel.
    void fill_shader(const std::string& name, const std::string& target, const std::string& expression,
                     const std::string& declarations = "") const {
        shader(name, "layout(local_size_x = 8, local_size_y = 8) in;\n" + declarations + "\nlayout(FORMAT_" + target +
                         ") writeonly uniform image2D " + target +
                         ";\nvoid main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  if "
                         "(any(greaterThanEqual(p, imageSize(" +
                         target + ")))) return;\n  imageStore(" + target + ", p, vec4(" + expression + "));\n}\n");
    }

    TempRoot root{true};
};

/// The same without OpenGL: plans only.
class PlanTest : public testing::Test {
  protected:
    std::filesystem::path graph_file(const std::string& members) const {
        root.write("assets/graphs/g.json", "{\"version\": 1, " + members + "}");
        return root / "assets/graphs/g.json";
    }
    void shader(const std::string& name, const std::string& slots) const {
        root.write("glsl/" + name, "layout(local_size_x = 8) in;\n" + slots + "\nvoid main() {}\n");
    }
    GraphModel model(const std::string& members) const { return GraphModel(read_graph_file(graph_file(members))); }
    Plan plan(const std::string& members, const SceneFacts& facts = {}, glm::ivec2 size = {640, 360}) const {
        return model(members).plan(facts, size);
    }
    static std::vector<std::string> order(const Plan& plan) {
        std::vector<std::string> ids;
        for (const PlanPass& pass : plan.passes)
            ids.push_back(pass.id);
        return ids;
    }

    TempRoot root{true};
};

} // namespace bounce
