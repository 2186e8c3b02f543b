// Finds things in a plan by name, and counts of the scene.
#include "graph/model.h"

#include <algorithm>
#include <utility>

namespace bounce {

const PlanSlot* PlanPass::find(const std::string& slot) const {
    for (const PlanSlot& s : slots) {
        if (s.use.slot == slot) return &s;
    }
    return nullptr;
}

uint64_t Plan::total_bytes() const {
    uint64_t bytes = 0;
    for (const PlanResource& resource : resources)
        bytes += resource.total_bytes();
    return bytes;
}

const PlanResource* Plan::find_resource(const std::string& name) const {
    for (const PlanResource& resource : resources) {
        if (resource.name() == name) return &resource;
    }
    return nullptr;
}

bool PlanPass::runs(const std::string& program) const {
    return std::find(programs.begin(), programs.end(), program) != programs.end();
}

std::vector<std::string> Plan::resource_names() const {
    std::vector<std::string> names;
    for (const PlanResource& resource : resources)
        names.push_back(resource.name());
    return names;
}

std::optional<double> side_of(const PlanResource& resource, const std::string& side) {
    if (side == "width") return resource.texture.size.x;
    if (side == "height") return resource.texture.size.y;
    if (side == "depth") return resource.texture.size.z;
    if (side == "mips") return resource.texture.mips;
    if (side == "count") return double(resource.count);
    return std::nullopt;
}

std::optional<double> number_in_frame(const GraphModel& model, const Plan& plan, const std::string& name) {
    size_t last = name.rfind('.');
    if (last != std::string::npos) {
        const PlanResource* resource = plan.find_resource(name.substr(0, last));
        auto side = resource ? side_of(*resource, name.substr(last + 1)) : std::nullopt;
        if (side) return side;
    }
    return model.number(name);
}

std::optional<double> scene_fact(const SceneFacts& facts, const std::string& name) {
    const std::pair<const char*, double> known_facts[] = {
        {"lights", double(facts.lights())},
        {"point_lights", double(facts.point_lights)},
        {"spot_lights", double(facts.spot_lights)},
        {"directional_lights", double(facts.directional_lights)},
        {"emissive_materials", double(facts.emissive_materials)},
        {"glossy_materials", double(facts.glossy_materials)},
        {"alpha_tested_materials", double(facts.alpha_tested_materials)},
        {"blended_materials", double(facts.blended_materials)},
        {"dynamic_instances", double(facts.dynamic_instances)},
        {"animated_lights", facts.animated_lights ? 1.0 : 0.0},
        {"environment", facts.environment ? 1.0 : 0.0},
    };
    for (const auto& [known, value] : known_facts) {
        if (name == known) return value;
    }
    return std::nullopt;
}

} // namespace bounce
