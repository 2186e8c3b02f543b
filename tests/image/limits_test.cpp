// Every graph of the project fits the smallest driver that OpenGL 4.6 allows, three limits apart, and what is counted
// in the text of its shaders is at least what the driver counts in its programs.
#include "app/session.h"
#include "gpu/driver_limits.h"
#include "graph/plan_needs.h"
#include "scene/describe.h"
#include "support/errors.h"
#include "support/every_graph.h"
#include "support/gpu_context.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <set>

using namespace bounce;

namespace {

/// What raster passes and the programs with most outputs need beyond the specification's minimum, which is 0 storage
/// blocks for vertices and for primitives, and 8 images, storage blocks and colours together.
const char* const k_smallest = "minimum,GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS=3,GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS=1,"
                               "GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES=16";

struct Pretend {
    explicit Pretend(const std::string& limits) { pretend_limits(limits); }
    ~Pretend() { pretend_limits(""); }
};

} // namespace

/// As published, and with all passes that are off switched on; at the size that methods are measured at.
TEST(MinimumLimits, EveryGraphFitsThem) {
    TempFolder folder;
    const Shot shot = load_shot(tiny_shot(folder));
    const SceneFacts facts = shot_facts(shot);
    Pretend minimum(k_smallest);
    for (const std::string& name : graph_names()) {
        for (bool all : {false, true}) {
            GraphModel model(read_graph_file(find_graph(name)));
            for (const auto& node : model.nodes())
                if (all) node->enabled = true;
            std::string told;
            try {
                const Plan plan = model.plan(facts, {1280, 720});
                EXPECT_GT(plan_needs(model, plan).size(), 10u) << name;
                check_plan_limits(model, facts, plan);
            } catch (const Error& problem) {
                told = problem.what();
            }
            EXPECT_EQ(told, "") << name << (all ? " with all passes" : "");
        }
    }
}

class MinimumLimitsOnADriver : public GpuTest {};

TEST_F(MinimumLimitsOnADriver, TheTextCountsAtLeastWhatTheDriverDoes) {
    TempFolder folder;
    const std::string shot = tiny_shot(folder);
    Pretend minimum(k_smallest);
    size_t programs = 0, equal = 0;
    for (const std::string& name : graph_names()) {
        SessionOptions options;
        options.shot = shot;
        options.graph = name;
        options.size = {64, 36};
        Session session(options);
        GraphModel& model = session.graph().model();
        for (const PlanPass& pass : session.graph().plan().passes) {
            for (const auto& program : model.nodes()[size_t(pass.node)]->programs) {
                if (!pass.runs(program->name())) continue;
                std::set<std::string> samplers, images, blocks;
                glm::ivec3 local(1);
                for (size_t i = 0; i < program->sources().size(); ++i) {
                    const ShaderNeeds needs = shader_needs(program->sources()[i].text, stage_of(program->stages()[i]));
                    samplers.insert(needs.samplers.begin(), needs.samplers.end());
                    images.insert(needs.images.begin(), needs.images.end());
                    blocks.insert(needs.storage_blocks.begin(), needs.storage_blocks.end());
                    local = needs.local_size;
                }
                const ProgramInterface& linked = program->interface();
                const auto count = [](const std::vector<OpaqueInfo>& all) {
                    size_t sum = 0;
                    for (const OpaqueInfo& one : all)
                        sum += size_t(one.count);
                    return sum;
                };
                const std::string where = name + ": " + pass.id + "/" + program->name();
                EXPECT_TRUE(program->usable()) << where;
                EXPECT_GE(samplers.size(), count(linked.samplers)) << where;
                EXPECT_GE(images.size(), count(linked.images)) << where;
                EXPECT_GE(blocks.size(), linked.storage_blocks.size()) << where;
                EXPECT_EQ(local, linked.local_size) << where;
                for (const BlockInfo& block : linked.storage_blocks)
                    EXPECT_TRUE(blocks.contains(block.name)) << where << ": " << block.name;
                ++programs;
                equal += samplers.size() == count(linked.samplers) && images.size() == count(linked.images) &&
                         blocks.size() == linked.storage_blocks.size();
            }
        }
    }
    std::cout << equal << " of " << programs << " programs are counted as the driver counts them\n";
    EXPECT_GT(10 * equal, 9 * programs) << "the count from the text means little";
}
