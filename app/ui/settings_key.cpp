#include "app/ui/settings_key.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

std::string settings_key(const Session& session) {
    const Graph& graph = session.graph();
    std::string key =
        fmt::format("{} {} {} {}x{} {} {}", session.options().shot, session.edits(), session.options().graph,
                    session.size().x, session.size().y, graph.plans(), graph.model().values().options());
    if (session.camera_is_set()) {
        const Camera camera = session.camera();
        for (const glm::vec3& v : {camera.position, camera.target, camera.up})
            key += fmt::format(" {} {} {}", v.x, v.y, v.z);
        key += fmt::format(" {}", camera.vfov);
    }
    return key;
}

bool times_are_current(const Graph& graph) {
    return std::all_of(graph.plan().passes.begin(), graph.plan().passes.end(), [&](const PlanPass& pass) {
        const PassTiming timing = graph.timing(pass.id);
        return timing.samples > 0 || timing.unchanged;
    });
}

bool is_timed(const Graph& graph) {
    return std::all_of(graph.plan().passes.begin(), graph.plan().passes.end(),
                       [&](const PlanPass& pass) { return graph.timing(pass.id).samples > 0; });
}

double whole_frame_ms(const Graph& graph) {
    double sum = 0;
    for (const PlanPass& pass : graph.plan().passes)
        sum += graph.timing(pass.id).median;
    return sum;
}

} // namespace bounce
