#include "app/commands/session_options.h"

#include "core/error.h"
#include "core/scanner.h"
#include "gpu/shader_limits.h"

#include <fmt/format.h>

namespace bounce {

void SessionArguments::add_to(CLI::App& command, bool shot_required) {
    auto* shot_option =
        command.add_option("shot", shot, "a shot (name or .json), or a scene (.gltf, .glb)")->type_name("SHOT");
    if (shot_required) shot_option->required();
    command.add_option("--graph,-g", graph, "a graph: name or .json")->type_name("GRAPH")->capture_default_str();
    add_settings_to(command);
}

void SessionArguments::add_settings_to(CLI::App& command) {
    command.add_option("--set", sets, "a parameter: pass.name=value (repeatable; `bounce params` lists them)")
        ->allow_extra_args(false);
    command.add_option("--enable", enabled, "switch on a pass that the graph has off, and what it needs (repeatable)")
        ->allow_extra_args(false);
    command.add_option("--disable", disabled, "switch off a pass (repeatable)")->allow_extra_args(false);
    command.add_option("--size", size, "WxH instead of the shot's size");
    command.add_option("--material-model", material_model, "plain, gltf or appendix_b instead of the shot's");
    command.add_option("--device", device, "which EGL device (see --list-devices)");
    command
        .add_option("--shader-limit", shader_limits,
                    "name=number: what shader text may hold at most, as private_bytes=262144 (repeatable)")
        ->allow_extra_args(false);
    command.add_flag("--check-nan", check_nan, "look for values that are not finite after every pass");
}

SessionOptions SessionArguments::options() const {
    SessionOptions out;
    out.shot = shot;
    out.graph = graph;
    out.check_nan = check_nan;
    if (!material_model.empty()) out.material_model = material_model_named(material_model);
    for (const std::string& limit : shader_limits)
        set_shader_limit(limit);
    for (const std::string& set : sets) {
        size_t equals = set.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw Error(fmt::format("--set {}: it is written pass.parameter=value", set));
        }
        out.sets.emplace_back(set.substr(0, equals), set.substr(equals + 1));
    }
    for (const std::string& id : enabled)
        out.switches.emplace_back(id, true);
    for (const std::string& id : disabled)
        out.switches.emplace_back(id, false);
    if (!size.empty()) {
        auto read = scan_size(size, 1, 5);
        if (!read) throw Error(fmt::format("--size {}: it is written WxH, as 1280x720", shortened(size)));
        glm::ivec2 pixels(read->first, read->second);
        if (pixels.x < 1 || pixels.y < 1 || pixels.x > 16384 || pixels.y > 16384) {
            throw Error(fmt::format("--size {}: each side is 1 … 16384", size));
        }
        out.size = pixels;
    }
    return out;
}

} // namespace bounce
