#include "app/ui/open.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/paths.h"
#include "scene/scene_formats.h"

#include <algorithm>

namespace bounce {

namespace fs = std::filesystem;

SceneBaseline baseline_of(const Session& session) {
    const Shot& shot = session.shot();
    SceneBaseline baseline;
    baseline.lights = shot.scene.lights;
    baseline.light_nodes.resize(baseline.lights.size());
    for (const Node& node : shot.scene.nodes) {
        if (node.light >= 0) baseline.light_nodes[size_t(node.light)] = node;
    }
    baseline.materials = shot.scene.materials;
    baseline.environment = shot.environment.radiance;
    baseline.diffuse_only = shot.diffuse_only;
    baseline.normal_maps = shot.normal_maps;
    baseline.material_model = shot.material_model;
    return baseline;
}

void ask_for_shot(PanelContext& context, const std::string& name) {
    context.ui.say("opening " + name + " …");
    context.ui.window.ask([&session = context.session, &ui = context.ui, &undo = context.undo, name] {
        session.open_shot(name);
        undo.clear();
        ui.window.opened = baseline_of(session);
        ui.window.capture.saved_shot.clear();
        ui.cursor_locked = false;
        ui.cursor_pixel = glm::ivec2(-1);
        ui.redraw();
        ui.say("opened " + session.shot().path.string());
    });
}

void ask_for_graph(PanelContext& context, const std::string& name) {
    context.ui.say("opening graph " + name + " …");
    context.ui.window.ask([&session = context.session, &ui = context.ui, name] {
        session.open_graph(name);
        ui.redraw();
        ui.say("opened " + session.graph().model().file().path.string());
    });
}

void ask_for_file(PanelContext& context, const std::string& path) {
    if (scene_format_of(path)) return ask_for_shot(context, path);
    if (fs::path(path).extension() != ".json") {
        return context.ui.say("'" + path + "' cannot be opened: expected a scene (" + scene_extensions() +
                                  "), or a shot or graph (.json)",
                              true);
    }
    try {
        auto root = read_json_file(path);
        if (root.is_object() && root.contains("passes")) return ask_for_graph(context, path);
        if (root.is_object() && root.contains("scene")) return ask_for_shot(context, path);
        context.ui.say("'" + path + "' is neither a shot (it has no 'scene') nor a graph (it has no 'passes')", true);
    } catch (const std::exception& error) {
        context.ui.say("'" + path + "': " + error.what(), true);
    }
}

std::vector<std::string> asset_names(const char* folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(assets_folder() / folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace bounce
