#include "graph/scope.h"

#include "graph/model.h"

namespace bounce {

static std::vector<std::pair<const char*, double>> facts_of(const SceneFacts& facts) {
    return {{"lights", double(facts.lights())},
            {"point_lights", double(facts.point_lights)},
            {"spot_lights", double(facts.spot_lights)},
            {"directional_lights", double(facts.directional_lights)},
            {"shadow_views", double(facts.spot_lights + facts.directional_lights + 6 * facts.point_lights)},
            {"emissive_materials", double(facts.emissive_materials)},
            {"glossy_materials", double(facts.glossy_materials)},
            {"alpha_tested_materials", double(facts.alpha_tested_materials)},
            {"blended_materials", double(facts.blended_materials)},
            {"dynamic_instances", double(facts.dynamic_instances)},
            {"animated_lights", facts.animated_lights ? 1.0 : 0.0},
            {"environment", facts.environment ? 1.0 : 0.0},
            {"triangles", double(facts.triangles)}};
}

std::optional<double> scene_fact(const SceneFacts& facts, const std::string& name) {
    for (const auto& [known, value] : facts_of(facts))
        if (name == known) return value;
    return std::nullopt;
}

std::vector<std::string> scene_fact_names() {
    std::vector<std::string> names;
    for (const auto& [known, value] : facts_of({}))
        names.push_back(known);
    return names;
}

Scope& Scope::of_plan(const Plan& plan) {
    size = plan.size;
    resource = [&plan](const std::string& name) { return plan.find_resource(name); };
    resource_names = [&plan] { return plan.resource_names(); };
    return *this;
}

std::optional<double> Scope::number(const std::string& name) const {
    if (name == "iteration" && iteration) return *iteration;
    if (name == "width" && size.x > 0) return size.x;
    if (name == "height" && size.y > 0) return size.y;
    if (auto fact = facts ? scene_fact(*facts, name) : std::nullopt) return fact;
    if (auto parameter = model.number(name)) return parameter;
    size_t last = name.rfind('.');
    const PlanResource* found = resource && last != std::string::npos ? resource(name.substr(0, last)) : nullptr;
    return found ? side_of(*found, name.substr(last + 1)) : std::nullopt;
}

std::vector<std::string> Scope::known() const {
    std::vector<std::string> names;
    if (iteration) names.push_back("iteration");
    if (size.x > 0) names.insert(names.end(), {"width", "height"});
    if (facts)
        for (const std::string& fact : scene_fact_names())
            names.push_back(fact);
    for (const std::string& parameter : model.parameter_names())
        names.push_back(parameter);
    if (!resource_names) return names;
    for (const std::string& of : resource_names())
        for (const char* side : {"width", "height", "depth", "mips", "count"})
            names.push_back(of + "." + side);
    return names;
}

Names Scope::names() const {
    Names names([this](const std::string& name) { return number(name); });
    names.choices = [this](const std::string& name) { return model.choices(name); };
    names.known = [this] { return known(); };
    return names;
}

} // namespace bounce
