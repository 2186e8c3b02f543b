#include "graph/plan_remedy.h"

#include "core/parameter_steps.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace bounce {

namespace {

class Remedy {
  public:
    Remedy(GraphModel& model, const SceneFacts& facts, const Plan& plan, const PlanMeasure& measure, bool choices)
        : model_(model), facts_(facts), plan_(plan), measure_(measure), choices_(choices) {}

    std::string text(const std::function<std::string(double)>& shown) {
        best_ = measure_(model_, plan_);
        const double before = best_;
        try_set("graph", model_.graph_parameters());
        for (const auto& node : model_.nodes())
            if (plan_has(node->id())) try_set(node->id(), node->parameters);
        if (double at_half = measured(plan_.size / 2); at_half < best_) {
            best_ = at_half;
            change_ = fmt::format("lower the size ({}x{}): half of it", plan_.size.x, plan_.size.y);
        }
        if (best_ < before) return fmt::format("{} would need {}", change_, shown(best_));
        return fewer_lights_help(before)
                   ? fmt::format("use fewer lights ({}; a point light counts six times)", facts_.lights())
                   : std::string();
    }

  private:
    bool plan_has(const std::string& id) const {
        return std::any_of(plan_.passes.begin(), plan_.passes.end(),
                           [&](const PlanPass& pass) { return pass.id == id; });
    }

    double measured(glm::ivec2 size) const { return measured(facts_, size); }

    double measured(const SceneFacts& facts, glm::ivec2 size) const {
        try {
            return measure_(model_, model_.plan(facts, glm::max(size, glm::ivec2(1))));
        } catch (const Error&) {
            return std::numeric_limits<double>::infinity(); // no plan at all with this value
        }
    }

    bool fewer_lights_help(double before) const {
        SceneFacts fewer = facts_;
        for (size_t* count : {&fewer.point_lights, &fewer.spot_lights, &fewer.directional_lights})
            *count = (*count + 1) / 2; // one stays one, so that the same passes run
        return measured(fewer, plan_.size) < before;
    }

    /// What is compiled in tells which slots there are.
    void scan(const std::string& id) {
        for (const auto& node : model_.nodes())
            if (node->id() == id || node->entry.params_of == id) model_.scan(*node);
    }

    /// `p`: a copy, since a scan may move what is in the set.
    bool is_better(const std::string& id, ParameterSet& set, const Parameter& p, const ParameterValue& other) {
        const bool compiled_in = p.info.is_static && id != "graph";
        set.set(p.info.name, other, ParameterOrigin::panel); // a scan puts defaults back to what the text says
        if (compiled_in) scan(id);
        const double with = measured(plan_.size);
        set.set(p.info.name, p.value, p.origin);
        if (compiled_in) scan(id);
        if (!(with < best_)) return false;
        best_ = with;
        return true;
    }

    void try_set(const std::string& id, ParameterSet& set) {
        for (size_t i = 0; i < set.all().size(); ++i) {
            const Parameter p = set.all()[i];
            const std::string name = id + "." + p.info.name;
            const bool shapes = !p.info.in_shader || p.info.is_static || id == "graph";
            if (p.info.kind == ParameterKind::integer) {
                const int value = std::get<int>(p.value);
                int half = value / 2;
                if (auto beside = steps_beside(p.info, p.value); !beside.empty()) half = std::get<int>(beside.front());
                if (half >= 1 && half < value && half >= p.info.min && half <= p.info.max &&
                    is_better(id, set, p, half))
                    change_ = fmt::format("lower {} ({}): {}", name, value,
                                          2 * half == value ? "half of it" : std::to_string(half));
            } else if (choices_ && shapes && p.info.kind == ParameterKind::boolean) {
                const bool value = std::get<bool>(p.value);
                if (is_better(id, set, p, !value)) change_ = fmt::format("set {}={}: it", name, !value);
            } else if (choices_ && shapes && p.info.kind == ParameterKind::enumeration) {
                for (int choice = 0; choice < int(p.info.choices.size()); ++choice)
                    if (choice != std::get<int>(p.value) && is_better(id, set, p, choice))
                        change_ = fmt::format("set {}={}: it", name, p.info.choices[size_t(choice)]);
            }
        }
    }

    GraphModel& model_;
    const SceneFacts& facts_;
    const Plan& plan_;
    const PlanMeasure& measure_;
    const bool choices_;
    double best_ = 0;
    std::string change_;
};

} // namespace

std::string plan_remedy(GraphModel& model, const SceneFacts& facts, const Plan& plan, const PlanMeasure& measure,
                        const std::function<std::string(double)>& shown, bool choices) {
    return Remedy(model, facts, plan, measure, choices).text(shown);
}

} // namespace bounce
