#include "app/experiments/transport.h"

#include "core/comparison.h"
#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

OcclusionFalloff occlusion_falloff(const std::string& name) {
    const auto found = std::find(k_occlusion_falloffs.begin(), k_occlusion_falloffs.end(), name);
    if (found != k_occlusion_falloffs.end()) return OcclusionFalloff(found - k_occlusion_falloffs.begin());
    const std::vector<std::string> known(k_occlusion_falloffs.begin(), k_occlusion_falloffs.end());
    throw Error("the reference has no falloff '" + name + "' of occlusion (it has: " + join(known, ", ") + ")");
}

ReferenceSettings transport_settings(const GraphModel& model) {
    const Transport& transport = model.file().transport;
    ReferenceSettings settings;
    settings.bounces = transport.bounces;
    settings.diffuse_only = transport.diffuse_only;
    settings.diffuse_secondary = transport.diffuse_secondary;
    if (!transport.occlusion_distance.empty()) {
        const auto distance = model.number(transport.occlusion_distance);
        if (!distance || !(*distance > 0))
            throw Error(fmt::format("transport: '{}' is no distance above 0", transport.occlusion_distance));
        settings.occlusion_distance = float(*distance);
    }
    if (!transport.occlusion_falloff.empty()) {
        const Parameter& parameter = model.parameter(transport.occlusion_falloff);
        settings.occlusion_falloff = occlusion_falloff(to_text(parameter.info, parameter.value));
    }
    return settings;
}

bool only_occlusion(const std::vector<std::string>& parts) {
    return !parts.empty() && std::none_of(parts.begin(), parts.end(), is_radiance);
}

std::string parts_text(const std::vector<std::string>& parts) {
    std::vector<std::string> names;
    for (const std::string& part : parts)
        names.push_back(part.starts_with("out.") ? part.substr(4) : part);
    return join(names, " + ");
}

std::string transport_text(int bounces, const std::vector<std::string>& parts) {
    if (only_occlusion(parts)) return "occlusion: " + parts_text(parts);
    const std::string orders = bounces < 0    ? "all light"
                               : bounces == 1 ? "1 bounce"
                                              : fmt::format("{} bounces", bounces);
    return orders + ": " + parts_text(parts);
}

} // namespace bounce
