#include "app/ui/stability_run.h"

#include "core/problem.h"
#include "graph/shader_log.h"

#include <exception>

namespace bounce {

void StabilityRun::start(const Session& session) {
    const GraphModel& model = session.graph().model();
    Variant own;
    for (const auto& [name, text] : session.changed_parameters(ParameterOrigin::command_line))
        own.sets[name] = text;
    for (const auto& [pass, on] : model.values().switches)
        own.switches[pass] = on;
    problem_.clear();
    measurement_.reset();
    measurement_ = std::make_unique<StabilityMeasurement>(load_stability_case(chosen), model.file().path.string(), own);
    graph_ = model.file().name;
    values_ = model.values().options();
    running_ = true;
}

bool StabilityRun::stale(const Session& session) const {
    const GraphModel& model = session.graph().model();
    return model.file().name != graph_ || model.values().options() != values_;
}

void StabilityRun::step() {
    if (!running_) return;
    try {
        measurement_->step();
        running_ = !measurement_->done();
    } catch (const std::exception& error) {
        problem_ = problem_text(error);
        running_ = false;
    }
}

} // namespace bounce
