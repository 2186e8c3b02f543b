// Which passes a pass or a resource that is asked for needs switched on.
#include "core/text.h"
#include "graph/model.h"
#include "graph/script_pass.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace bounce {

namespace {

/// A scene in which nearly every pass has something to do: switches are set before the scene is known.
SceneFacts usual_scene() {
    SceneFacts facts;
    facts.triangles = facts.vertices = 1000;
    facts.materials = facts.instances = 1;
    facts.glossy_materials = facts.emissive_materials = facts.alpha_tested_materials = 1;
    facts.blended_materials = 1;
    facts.point_lights = facts.spot_lights = facts.directional_lights = 1;
    facts.environment = true;
    facts.bounds = facts.bounds_over_animation = {glm::vec3(-1), glm::vec3(1)};
    return facts;
}

/// What the pass reads and writes with its present parameters: by its shaders, and what it declares beside them (the
/// targets that it draws to). A pass of its own is asked, since declare() may remember things for execute().
std::vector<SlotUse> uses_of(const PassNode& node) {
    ParameterSet parameters;
    PassDescription description(parameters);
    std::unique_ptr<Pass> pass = make_pass(node.entry);
    pass->describe(description);
    for (const Parameter& own : node.parameters.all())
        if (parameters.find(own.info.name)) parameters.set(own.info.name, own.value, own.origin);
    const SceneFacts facts = usual_scene();
    Declaration declaration(facts, glm::ivec2(64), [&](const std::string& name) {
        const Program* program = node.program(name);
        return program ? program->slots() : std::vector<ShaderSlot>();
    });
    try {
        pass->declare(declaration);
    } catch (const Error&) {
        // The plan reports it; what was declared before stands.
    }
    return declaration.slot_uses();
}

/// What the passes of a graph read and write.
class Makers {
  public:
    explicit Makers(const GraphModel& model) {
        for (const auto& node : model.nodes())
            uses_[node.get()] = uses_of(*node);
    }
    const std::vector<SlotUse>& uses(const PassNode& node) const { return uses_.at(&node); }
    bool writes(const PassNode& node, const std::string& resource) const {
        return std::any_of(uses(node).begin(), uses(node).end(), [&](const SlotUse& use) {
            return use.writes && node.target_of(use.slot).resource == resource;
        });
    }
    /// Some pass that is on writes it.
    bool is_made(const std::string& resource) const {
        return std::any_of(uses_.begin(), uses_.end(),
                           [&](auto& of) { return of.first->enabled && writes(*of.first, resource); });
    }

  private:
    std::map<const PassNode*, std::vector<SlotUse>> uses_;
};

} // namespace

/// Those of `open` that are off, and, of what they read and no pass that is on makes, those that would.
std::vector<std::string> GraphModel::off_among(std::vector<const PassNode*> open) const {
    const Makers makers(*this);
    std::vector<std::string> ids;
    for (size_t i = 0; i < open.size(); ++i) {
        const PassNode& node = *open[i];
        if (!node.enabled) ids.push_back(node.id());
        for (const SlotUse& use : makers.uses(node)) {
            std::string resource = node.target_of(use.slot).resource;
            if (!use.reads || use.writes || makers.is_made(resource)) continue;
            for (const auto& maker : nodes_) {
                bool known = std::find(open.begin(), open.end(), maker.get()) != open.end();
                if (!known && makers.writes(*maker, resource)) open.push_back(maker.get());
            }
        }
    }
    return ids;
}

std::vector<std::string> GraphModel::off_before(const std::string& id) const {
    const PassNode* node = find_node(id);
    return node ? off_among({node}) : std::vector<std::string>();
}

std::vector<std::string> GraphModel::off_for(const std::string& resource) const {
    const Makers makers(*this);
    if (makers.is_made(resource)) return {};
    std::vector<const PassNode*> open;
    for (const auto& node : nodes_)
        if (makers.writes(*node, resource)) open.push_back(node.get());
    return off_among(open);
}

void GraphModel::switch_pass(const std::string& id, bool on) {
    PassNode* node = find_node(id);
    if (!node) {
        std::vector<std::string> names;
        for (const auto& known : nodes_)
            names.push_back(known->id());
        throw Error(fmt::format("graph '{}' has no pass '{}'{}", file_.name, id, did_you_mean(id, names)));
    }
    if (!on) node->enabled = false;
    for (const std::string& off : on ? off_before(id) : std::vector<std::string>())
        find_node(off)->enabled = true;
}

void GraphModel::ask_for(const std::string& resource) {
    asked_.insert(resource);
    for (const std::string& off : off_for(resource))
        switch_pass(off, true);
}

} // namespace bounce
