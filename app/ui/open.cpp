#include "app/ui/open.h"

#include "app/ui/captures.h"
#include "app/ui/open_dialog.h"
#include "app/ui/shot_writer.h"
#include "app/ui/texture_view.h"
#include "app/ui/work.h"
#include "core/error.h"
#include "core/image.h"
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
    for (int node : shot.object_nodes)
        baseline.object_nodes.push_back(shot.scene.nodes[size_t(node)]);
    baseline.camera = shot.camera;
    baseline.camera_path = shot.camera_path;
    baseline.materials = shot.scene.materials;
    baseline.environment = shot.environment.radiance;
    baseline.diffuse_only = shot.diffuse_only;
    baseline.normal_maps = shot.normal_maps;
    baseline.material_model = shot.material_model;
    return baseline;
}

static void open_shot(PanelContext& context, const std::string& name, bool as_in_its_file) {
    Session& session = context.session;
    UiState& ui = context.ui;
    keep_work(context);
    const std::string left = session.shot().name, left_key = shot_key(session);
    const bool kept = ui.window.work.shots.contains(left_key);
    session.open_shot(name);
    if (as_in_its_file) ui.window.work.shots.erase(shot_key(session));
    context.undo.clear();
    ui.window.opened = baseline_of(session);
    ui.window.capture.saved_shot.clear();
    ui.pinned_rays.reset();
    ui.chosen_light = ui.chosen_object = -1;
    ui.cursor_locked = false;
    ui.cursor_pixel = glm::ivec2(-1);
    ui.redraw();
    std::string told = "opened " + session.shot().path.string();
    ui.say(told);
    const std::string restored = restore_shot_work(context);
    if (ui.notice_is_error) return;
    if (!restored.empty()) told += " with your edits: " + restored + " (F5: as in its file)";
    if (kept && left_key != shot_key(session)) told += "; your edits of " + left + " are kept";
    ui.say(told);
}

void ask_for_shot(PanelContext& context, const std::string& name) {
    context.ui.say("opening " + name + " …");
    context.ui.window.ask([context, name]() mutable { open_shot(context, name, false); });
}

void read_shot_again(PanelContext& context) {
    context.ui.say("reading the shot again …");
    context.ui.window.ask(
        [context]() mutable { open_shot(context, std::string(context.session.options().shot), true); });
}

void ask_for_shot_again(PanelContext& context) {
    context.ui.window.discarding = edits_of_shot(context);
    if (context.ui.window.discarding.empty()) read_shot_again(context);
}

/// The values of `mine` that the present graph has taken over, and those that it has not, as people write them.
static std::pair<std::vector<std::string>, std::vector<std::string>> taken_over(const GraphModel& model,
                                                                                const GraphValues& mine) {
    std::vector<std::string> taken, left;
    for (const GraphValues::Value& value : mine.parameters) {
        const Parameter* now = model.find_parameter(value.name);
        const bool is = now && now->origin == value.origin && to_text(now->info, now->value) == value.text;
        (is ? taken : left).push_back(value.name + "=" + value.text);
    }
    for (const auto& [pass, on] : mine.switches) {
        const PassNode* node = model.find_node(pass);
        (node && node->enabled == on ? taken : left).push_back(pass + (on ? " on" : " off"));
    }
    return {taken, left};
}

static void open_graph(PanelContext& context, const std::string& name) {
    Session& session = context.session;
    UiState& ui = context.ui;
    keep_work(context);
    const GraphValues mine = session.graph().model().values();
    const std::string left_name = session.graph().model().file().name;
    session.open_graph(name);
    const auto [taken, left] = taken_over(session.graph().model(), mine);
    std::set<std::string> given; // what was set last counts
    for (const GraphValues::Value& value : mine.parameters)
        given.insert(value.name);
    for (const auto& [pass, on] : mine.switches)
        given.insert(pass);
    const std::string restored = restore_graph_work(context, given);
    pin(ui, session.graph(), "");
    std::string told = "opened graph " + session.graph().model().file().name;
    if (!taken.empty()) told += "; your edits went along: " + few_of(taken);
    if (!restored.empty()) told += "; there again: " + restored;
    if (!left.empty()) told += "; kept for " + left_name + ": " + few_of(left);
    ui.say(told);
}

void ask_for_graph(PanelContext& context, const std::string& name) {
    context.ui.say("opening graph " + name + " …");
    context.ui.window.ask([context, name]() mutable { open_graph(context, name); });
}

/// The present shot under that sky: a shot file of its own, beside other captures, which is opened.
static void ask_for_sky(PanelContext& context, const std::string& map) {
    context.ui.window.ask([context, map]() mutable {
        const fs::path folder = context.ui.window.capture.folder.empty() ? "." : context.ui.window.capture.folder;
        fs::create_directories(folder);
        nlohmann::json root = nlohmann::json::parse(shot_text(context.session, context.ui.window.opened, folder));
        root["environment"] = {
            {"map", fs::weakly_canonical(map).lexically_relative(fs::weakly_canonical(fs::absolute(folder))).string()}};
        const fs::path file = new_file(folder.string(), context.session.shot().name + "_sky", ".json");
        write_file_atomically(file, json_dump(root, 2) + "\n");
        open_shot(context, file.string(), true);
    });
}

void ask_for_file(PanelContext& context, const std::string& path) {
    const bool sky = fs::path(path).extension() == ".hdr";
    if (sky || scene_format_of(path)) {
        note_recent_file(context.ui.window, path);
        return sky ? ask_for_sky(context, path) : ask_for_shot(context, path);
    }
    if (fs::path(path).extension() != ".json") {
        return context.ui.say("'" + path + "' cannot be opened: expected a scene (" + scene_extensions() +
                                  "), a shot or graph (.json), or a sky (.hdr)",
                              true);
    }
    try {
        auto root = read_json_file(path);
        const bool graph = root.is_object() && root.contains("passes");
        if (graph || (root.is_object() && root.contains("scene"))) {
            note_recent_file(context.ui.window, path);
            return graph ? ask_for_graph(context, path) : ask_for_shot(context, path);
        }
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
