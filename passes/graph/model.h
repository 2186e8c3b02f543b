#pragma once
// A graph as loaded: its passes with their parameters and scanned shaders, and the planner. No OpenGL calls.

#include "core/error.h"
#include "graph/plan.h"
#include "scene/needs.h"

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

struct PassNode {
    NodeEntry entry;
    std::unique_ptr<Pass> pass;
    ParameterSet parameters;
    std::unique_ptr<PassDescription> description;
    std::vector<std::unique_ptr<Program>> programs;
    bool enabled = true;

    const std::string& id() const { return entry.id; }
    Program* program(const std::string& name) const;
    /// What a slot is bound to: by the graph file, else by the pass ("from" in its shader, PassDescription::bind), else
    /// the resource of its own name.
    BindEntry target_of(const std::string& slot) const;
};

/// Which passes run in a frame.
enum class Rebuild {
    every_frame, ///< all, as methods are measured
    on_change    ///< those whose inputs have changed; what the others made stands
};

/// What a person set, for a graph that takes another's place.
struct GraphValues {
    struct Value {
        std::string name;  ///< "id.parameter"
        std::string owner; ///< the pass's type, or "graph"
        ParameterKind kind = ParameterKind::real;
        std::string text;
        ParameterOrigin origin = ParameterOrigin::command_line;
    };
    std::vector<Value> parameters;                      ///< also those that were put back to their default
    std::vector<std::pair<std::string, bool>> switches; ///< pass → on or off, where the file says otherwise
    std::set<std::string> asked;                        ///< resources that somebody asked for
    /// As options of the command line: "--set a.b=1 --enable c".
    std::string options() const;
};

class GraphModel {
  public:
    /// Makes the passes, reads their shaders' text, applies the file's values. Throws Error with all problems.
    explicit GraphModel(GraphFile file);

    const GraphFile& file() const { return file_; }
    ParameterSet& graph_parameters() { return graph_parameters_; }
    const ParameterSet& graph_parameters() const { return graph_parameters_; }
    std::vector<std::unique_ptr<PassNode>>& nodes() { return nodes_; }
    const std::vector<std::unique_ptr<PassNode>>& nodes() const { return nodes_; }
    PassNode* find_node(const std::string& id) const;

    /// "id.parameter" (graph.parameter for the graph's own) from text. Throws Error naming the nearest.
    void set(const std::string& name, const std::string& text, ParameterOrigin origin);
    /// Whether any parameter is set to "auto"; with `open`, whether one still waits for the scene's needs.
    bool has_auto(bool open = false) const;
    /// What is set to "auto" takes its values from these needs, with their reasons.
    void resolve_auto(const SceneNeeds& needs);
    Parameter& parameter(const std::string& name);
    const Parameter& parameter(const std::string& name) const;
    /// The same; null when there is none.
    const Parameter* find_parameter(const std::string& name) const;
    /// What a uniform of the pass takes its value from: its own parameter, or that of the pass that `params_of` names.
    const Parameter* parameter_of(const PassNode& node, const std::string& name) const;
    /// The value of a scalar parameter ("id.name", "graph.name" or the bare name of one of the graph's own).
    std::optional<double> number(const std::string& name) const;
    /// From note_numbers(true) on, number() notes whose values it gives ("id.name"); note_numbers(false) returns them.
    std::set<std::string> note_numbers(bool on) const;
    /// The parameters that were set since the last call ("id.name").
    std::set<std::string> take_changes() { return std::exchange(changes_, {}); }
    /// Of the graph's own parameter "rebuild", which every graph has.
    Rebuild rebuild() const;
    void set_default_rebuild(Rebuild rebuild);
    /// The choices of an enumeration, by the same names; null for what is none.
    const std::vector<std::string>* choices(const std::string& name) const;
    /// Every parameter as "id.name".
    std::vector<std::string> parameter_names() const;

    /// The passes that are off and without which this one has not all that it reads, itself included if it is off.
    std::vector<std::string> off_before(const std::string& id) const;
    /// The passes that are off and without which nothing makes this resource.
    std::vector<std::string> off_for(const std::string& resource) const;
    /// Switches a pass; with it come on those that are off and make what it reads. Throws Error naming the nearest.
    void switch_pass(const std::string& id, bool on);
    /// Somebody wants to see this resource: passes that are off and make it come on, and plans keep them also where
    /// only skipped passes would read it. A resource that nothing makes is told by who looks it up.
    void ask_for(const std::string& resource);
    bool is_asked_for(const std::string& resource) const { return asked_.contains(resource); }

    /// Reads a node's shader files again; its //! parameters and slots follow.
    void scan(PassNode& node, const Defines& formats = {});
    /// What its shaders' text asks to be compiled with: static parameters as GLSL, its own and those of `params_of`.
    Defines static_values(const PassNode& node) const;

    /// Throws Error with all problems (a slot without a source, a cycle, a bad size …).
    Plan plan(const SceneFacts& facts, glm::ivec2 size) const;
    /// Every file whose change matters: the graph file and the closures of all shaders.
    std::vector<std::filesystem::path> files() const;
    GraphValues values() const;
    /// Takes over what a person set in another graph, or in this one at another time, as far as there are such passes
    /// with such parameters, whose ranges allow it.
    void adopt_values(const GraphValues& values);
    /// Takes compiled programs from another model where the pass and the shader files are the same; what stood here
    /// goes there.
    void adopt_programs(GraphModel& other);

  private:
    void apply_file_value(PassNode& node, const std::string& name, const std::string& text);
    void apply_file_values(PassNode& node, ErrorList& errors);
    void follow_change(const std::string& name);
    void scan_by_values(PassNode& node);
    const Parameter* find_number(const std::string& name) const;
    void note_number(const std::string& name) const;
    std::vector<std::string> off_among(std::vector<const PassNode*> open) const;

    GraphFile file_;
    ParameterSet graph_parameters_;
    std::vector<std::unique_ptr<PassNode>> nodes_;
    std::set<std::string> changes_;
    std::set<std::string> asked_; ///< resources
    mutable bool noting_ = false;
    mutable std::set<std::string> noted_;
};

} // namespace bounce
