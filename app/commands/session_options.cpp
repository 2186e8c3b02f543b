#include "app/commands/session_options.h"

#include "app/commands/option_checks.h"
#include "core/error.h"
#include "gpu/call_watch.h"
#include "gpu/driver_limits.h"
#include "gpu/shader_limits.h"
#include "graph/graph_file.h"
#include "scene/find_scene.h"

#include <fmt/format.h>

namespace bounce {

void SessionArguments::add_to(CLI::App& command, bool shot_required) {
    auto* shot_option =
        command.add_option("shot", shot, "a shot (name or .json), or a scene (.gltf, .glb)")->type_name("SHOT");
    if (shot_required) shot_option->required();
    command.add_option("--graph,-g", graph, "a graph: name or .json")
        ->type_name("GRAPH")
        ->check(not_empty())
        ->capture_default_str();
    add_settings_to(command);
}

void SessionArguments::add_settings_to(CLI::App& command) {
    command.add_option("--set", sets, "a parameter: pass.name=value (repeatable; `bounce params` lists them)")
        ->allow_extra_args(false);
    command.add_option("--enable", enabled, "switch on a pass that the graph has off, and what it needs (repeatable)")
        ->allow_extra_args(false);
    command.add_option("--disable", disabled, "switch off a pass (repeatable)")->allow_extra_args(false);
    command.add_option("--size", size, "WxH instead of the shot's size")->check(picture_size());
    add_material_model_option(command, material_model);
    add_device_option(command, device);
    command
        .add_option("--shader-limit", shader_limits,
                    "name=number: what shader text may hold at most, as private_bytes=262144 (repeatable)")
        ->check(shader_limit())
        ->allow_extra_args(false);
    add_limits_to(command, limits);
    command.add_flag("--check-nan", check_nan, "look for values that are not finite after every pass");
    command.add_flag("--check-hazards", check_hazards, "look for memory barriers that are missing between passes");
}

void SessionArguments::add_limits_to(CLI::App& command, std::string& limits) {
    command.add_option("--limits", limits, "act as a driver with fewer: 'minimum' of OpenGL 4.6, or GL_MAX_…=N,…")
        ->check(not_empty())
        ->type_name("LIMITS");
}

void SessionArguments::check_names() const {
    find_shot(shot);
    find_graph(graph);
}

SessionOptions SessionArguments::options() const {
    SessionOptions out;
    out.shot = shot;
    out.graph = graph;
    out.check_nan = check_nan;
    if (check_hazards) want_call_watch();
    if (!limits.empty()) pretend_limits(limits);
    if (!material_model.empty()) out.material_model = material_model_named(material_model);
    for (const std::string& limit : shader_limits)
        set_shader_limit(limit);
    for (const std::string& set : sets) {
        size_t equals = set.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw Error(fmt::format("invalid --set '{}': expected pass.parameter=value", set));
        }
        out.sets.emplace_back(set.substr(0, equals), set.substr(equals + 1));
    }
    for (const std::string& id : enabled)
        out.switches.emplace_back(id, true);
    for (const std::string& id : disabled)
        out.switches.emplace_back(id, false);
    if (!size.empty()) out.size = parse_size(size);
    return out;
}

} // namespace bounce
