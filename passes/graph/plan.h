#pragma once
// The plan of one frame: which passes run in which order, what each slot is bound to, sizes, barriers, and which passes
// skipped and why. Made without OpenGL, so `bounce graph` can print it anywhere.

#include "graph/graph_file.h"
#include "graph/pass.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace bounce {

struct PlanResource {
    ResourceDeclaration declaration;
    TextureDesc texture; ///< unless a buffer
    uint64_t count = 0;  ///< elements of a buffer
    uint64_t bytes = 0;  ///< of all mips, without last frame's copy
    bool needs_previous = false;
    std::vector<std::string> writers, readers; ///< pass ids in plan order
    bool is_buffer() const { return declaration.kind == ResourceKind::buffer; }
    const std::string& name() const { return declaration.name; }
    uint64_t total_bytes() const { return bytes * (needs_previous ? 2 : 1); }
};

struct PlanSlot {
    SlotUse use;
    int resource = -1;    ///< index into Plan::resources; −1: the neutral value, or one of the scene's own resources
    bool builtin = false; ///< scene.… or material.…: bound by the graph itself
    glm::vec4 neutral{0};
    BindEntry bind;             ///< mip and layer expressions, previous
    glm::ivec2 neutral_size{1}; ///< of what the neutral value stands for
};

struct PlanCounter {
    std::string label;
    int resource = -1; ///< index into Plan::resources: a buffer of 4-byte integers
    uint64_t element = 0;
    bool overflow = false;
};

struct PlanPass {
    int node = -1; ///< index into GraphModel::nodes
    std::string id;
    std::vector<std::string> programs; ///< that it runs
    std::vector<PlanSlot> slots;
    int repeat_from = 0, repeat_to = 1;
    std::string loop;             ///< passes in a row of the same one take their steps together; empty: none
    GLbitfield barriers = 0;      ///< before the first step
    GLbitfield step_barriers = 0; ///< between steps
    std::vector<PlanCounter> counters;
    std::vector<int> clears;        ///< resources cleared before it, because it writes them first
    std::set<ByteRange> facts_read; ///< of SceneFacts, by its declaration
    bool picture_size_read = false; ///< likewise
    const PlanSlot* find(const std::string& slot) const;
    bool runs(const std::string& program) const;
};

struct PlanSkip {
    std::string id;
    std::string reason;
};

struct Plan {
    glm::ivec2 size{0};
    std::vector<PlanPass> passes;
    std::vector<PlanSkip> skipped;
    std::vector<PlanResource> resources;
    std::set<std::string> numbers; ///< parameters ("id.name") that expressions of the plan take their values from
    uint64_t total_bytes() const;
    const PlanResource* find_resource(const std::string& name) const;
    std::vector<std::string> resource_names() const;
};

/// "width", "height", "depth", "mips" or "count" of a resource.
std::optional<double> side_of(const PlanResource& resource, const std::string& side);
/// Fills in the barriers of passes and of their steps, from what each reads and writes.
void place_barriers(Plan& plan);

class GraphModel;
/// Passes in order, who reads and writes what, sizes in bytes, barriers, skipped passes with reasons.
std::string plan_text(const GraphModel& model, const Plan& plan);
/// The same as a Graphviz digraph.
std::string plan_graphviz(const GraphModel& model, const Plan& plan);

} // namespace bounce
