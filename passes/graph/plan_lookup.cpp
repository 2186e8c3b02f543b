// Finds things in a plan by name.
#include "graph/plan.h"

#include <algorithm>

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

} // namespace bounce
