#include "app/ui/widget_rects.h"

#include "app/ui/light_place.h"
#include "app/ui/live_comparison.h"
#include "app/ui/object_place.h"
#include "app/ui/pinned_rays.h"
#include "app/ui/settings_key.h"
#include "app/ui/snapshots.h"
#include "app/ui/timeline.h"
#include "app/ui/viewed.h"
#include "core/json_text.h"
#include "core/log.h"

#include <fstream>
#include <imgui.h>
#include <map>

namespace bounce {

namespace {
std::filesystem::path dump_file;
std::map<std::string, ImVec4> widgets;
uint64_t drawn = 0;
} // namespace

void note_rectangle(const std::string& name, float x0, float y0, float x1, float y1) {
    if (!dump_file.empty()) widgets[name] = ImVec4(x0, y0, x1, y1);
}

void note_widget(const std::string& name) {
    if (dump_file.empty()) return;
    ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    // What has scrolled out of its panel cannot be clicked.
    if (!ImGui::IsRectVisible(min, max)) return;
    note_rectangle(name, min.x, min.y, max.x, max.y);
}

void start_widget_dump(const std::filesystem::path& file) {
    dump_file = file;
}

void begin_widget_frame() {
    widgets.clear();
}

void end_widget_frame(const PanelContext& context) {
    if (dump_file.empty()) return;
    const Session& session = context.session;
    nlohmann::json json;
    json["drawn"] = ++drawn;
    json["rendered"] = session.graph().frames();
    json["frame"] = session.frame();
    json["plans"] = session.graph().plans();
    json["shot"] = session.options().shot;
    json["graph"] = session.options().graph;
    json["size"] = {session.size().x, session.size().y};
    json["camera"] = nlohmann::json::parse(camera_json(session.camera(), session.shot().scene.space));
    json["cursor"] = {context.ui.cursor_pixel.x, context.ui.cursor_pixel.y};
    json["notice"] = context.ui.notice;
    json["notice_is_error"] = context.ui.notice_is_error;
    json["last_capture"] = context.ui.window.capture.last;
    json["pinned"] = context.ui.pinned;
    json["pinned_rays"] = context.ui.pinned_rays ? context.ui.pinned_rays->all.size() : 0;
    json["mid_frame"] = context.ui.mid_frame;
    json["keys_shown"] = context.ui.show_keys;
    json["undo"] = context.undo.next_undo();
    json["problems"] = nlohmann::json::array();
    for (const GraphProblem& problem : session.graph().problems()) {
        json["problems"].push_back(problem.where + ": " + problem.error.text());
    }
    json["parameters"] = nlohmann::json::object();
    for (const auto& [name, text] : session.changed_parameters(ParameterOrigin::command_line)) {
        json["parameters"][name] = text;
    }
    json["filter"] = context.ui.parameter_filter;
    json["lights"] = nlohmann::json::array();
    for (size_t i = 0; i < session.shot().scene.lights.size() && i < 8; ++i) {
        const Light& light = session.shot().scene.lights[i];
        const LightPlace place = place_of_light(session, i).value_or(LightPlace());
        json["lights"].push_back({{"intensity", {light.intensity.r, light.intensity.g, light.intensity.b}},
                                  {"inner_cone", light.inner_cone},
                                  {"outer_cone", light.outer_cone},
                                  {"position", {place.position.x, place.position.y, place.position.z}},
                                  {"direction", {place.direction.x, place.direction.y, place.direction.z}},
                                  {"enabled", light.enabled}});
    }
    json["objects"] = nlohmann::json::array();
    for (size_t i = 0; i < session.shot().object_nodes.size(); ++i) {
        const ObjectPlace place = place_of_object(session, i);
        const glm::dquat& turn = place.rotation;
        json["objects"].push_back({{"position", {place.position.x, place.position.y, place.position.z}},
                                   {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                                   {"scale", {place.scale.x, place.scale.y, place.scale.z}}});
    }
    json["times"] = {{"passes_ms", whole_frame_ms(session.graph())},
                     {"current", times_are_current(session.graph())},
                     {"timed", is_timed(session.graph())}};
    for (const PlanPass& pass : session.graph().plan().passes) {
        const PassTiming timing = session.graph().timing(pass.id);
        json["times"]["runs"][pass.id] = timing.samples;
        json["times"]["ms"][pass.id] = timing.median;
    }
    json["viewed"] = {{"resource", viewed().resource},
                      {"range", {viewed().range.x, viewed().range.y}},
                      {"histogram", viewed().histogram},
                      {"false_colour", context.ui.viewer.false_colour}};
    json["bottom"] = context.ui.window.layout.show_bottom ? context.ui.window.bottom_tab : "";
    if (const Timeline* timeline = context.ui.timeline.get(); timeline && timeline->shown()) {
        const TimelineFrame& frame = *timeline->shown();
        json["timeline"] = {{"frames", timeline->frames.size()},
                            {"pinned", timeline->pinned},
                            {"number", frame.number},
                            {"passes_ms", frame.passes_ms()},
                            {"bytes", frame.bytes},
                            {"change", frame.change},
                            {"error", frame.error}};
    }
    json["snapshots"] = nlohmann::json::array();
    if (context.ui.snapshots)
        for (const Snapshot& snapshot : context.ui.snapshots->all)
            json["snapshots"].push_back(snapshot.name);
    if (const LiveComparison* comparison = context.ui.comparison.get()) {
        json["comparison"] = {{"view", int(comparison->view)},
                              {"split", comparison->split},
                              {"running", comparison->running()},
                              {"samples", comparison->samples()},
                              {"relative_rmse", comparison->figures()["relative_rmse"]},
                              {"caption", comparison->caption(session, 0)},
                              {"live_ms", comparison->live(session).ms},
                              {"points", comparison->points.size()}};
    }
    json["widgets"] = nlohmann::json::object();
    for (const auto& [name, r] : widgets)
        json["widgets"][name] = {r.x, r.y, r.z, r.w};

    // Aside and renamed, as everywhere, but not forced to the disk: this happens many times a second.
    std::filesystem::path aside = dump_file;
    aside += ".tmp";
    std::ofstream(aside) << json_dump(json, 1) << '\n';
    std::error_code error;
    std::filesystem::rename(aside, dump_file, error);
    if (error) spdlog::warn("cannot write '{}': {}", dump_file.string(), error.message());
}

} // namespace bounce
