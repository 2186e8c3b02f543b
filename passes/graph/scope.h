#pragma once
// The one scope of names that every expression of a graph file sees: sizes, counts, dispatches, needs, repeats, and the
// mips and layers that slots are bound to.
//
//   width, height                    the picture's size
//   lights, glossy_materials, …      counts of what the scene holds (scene_fact)
//   scale, graph.scale               a parameter of the graph itself
//   gather.interleave                a parameter of a pass; enumerations compare with their choices by name
//   gbuffer.normal.width             a side of a resource: width, height, depth, mips, count
//   iteration                        the step of a repeated pass (only where a pass runs)

#include "graph/expression.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

namespace bounce {

class GraphModel;
struct Plan;
struct PlanResource;

struct Scope {
    const GraphModel& model;
    const SceneFacts* facts = nullptr; ///< null: the scene is not known yet
    glm::ivec2 size{0};                ///< the picture's; 0: not known yet
    std::function<const PlanResource*(const std::string&)> resource;
    std::function<std::vector<std::string>()> resource_names;
    std::optional<int> iteration;

    /// The resources of a plan that is made.
    Scope& of_plan(const Plan& plan);

    std::optional<double> number(const std::string& name) const;
    std::vector<std::string> known() const;
    /// For evaluate(); the scope must outlive it.
    Names names() const;
};

/// A count of what the scene holds, by the name that expressions have for it ("emissive_materials").
std::optional<double> scene_fact(const SceneFacts& facts, const std::string& name);
std::vector<std::string> scene_fact_names();

} // namespace bounce
