#include "app/ui/ui_state_file.h"

#include "core/error.h"
#include "core/image.h"
#include "core/json_text.h"
#include "core/log.h"
#include "core/paths.h"
#include "scene/shot.h"

#include <algorithm>
#include <cmath>

namespace bounce {

using nlohmann::json;

namespace {

constexpr int k_version = 1;

std::filesystem::path state_path() {
    return state_folder() / "window.json";
}

/// Sets `to` when the key is there; a value of another type or out of range throws.
template <typename T>
void get(const json& from, const char* key, T& to) {
    if (from.contains(key)) to = from.at(key).get<T>();
}

void get_number(const json& from, const char* key, float& to, float least, float greatest) {
    float value = to;
    get(from, key, value);
    if (!std::isfinite(value)) throw std::runtime_error(std::string(key) + " is not a number");
    to = std::clamp(value, least, greatest);
}

void get_size(const json& from, const char* key, glm::ivec2& to, int least) {
    if (!from.contains(key)) return;
    to.x = std::clamp(from.at(key).at(0).get<int>(), least, 16384);
    to.y = std::clamp(from.at(key).at(1).get<int>(), least, 16384);
}

json vector_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

glm::vec3 vector_from(const json& value) {
    glm::vec3 v(value.at(0).get<float>(), value.at(1).get<float>(), value.at(2).get<float>());
    if (!std::isfinite(v.x + v.y + v.z)) throw std::runtime_error("a camera is not finite");
    return v;
}

Bookmark bookmark_from(const json& value) {
    Bookmark mark;
    get(value, "shot", mark.shot);
    get(value, "name", mark.name);
    mark.camera.position = vector_from(value.at("position"));
    mark.camera.target = vector_from(value.at("target"));
    mark.camera.up = vector_from(value.at("up"));
    get_number(value, "vfov", mark.camera.vfov, 0.001f, 3.1f);
    if (mark.camera.position == mark.camera.target) throw std::runtime_error("a camera looks nowhere");
    return mark;
}

void get_work(const json& from, const char* key, std::map<std::string, std::string>& to) {
    if (!from.contains(key)) return;
    for (const auto& [file, work] : from.at(key).items())
        to[file] = json_dump(work, -1);
}

json work_json(const std::map<std::string, std::string>& work) {
    json out = json::object();
    for (const auto& [file, text] : work)
        out[file] = json::parse(text);
    return out;
}

WindowState state_from(const json& root) {
    if (root.at("version") != k_version) throw std::runtime_error("it is of another version");
    WindowState state;
    get_number(root, "left", state.layout.left, 150, 2000);
    get_number(root, "right", state.layout.right, 150, 2000);
    get_number(root, "right_split", state.layout.right_split, 0.1f, 0.9f);
    get_number(root, "bottom_height", state.layout.bottom_height, 60, 2000);
    get(root, "show_bottom", state.layout.show_bottom);
    get(root, "bottom_tab", state.bottom_tab);
    get(root, "show_left", state.layout.show_left);
    get(root, "show_right", state.layout.show_right);
    get(root, "fit", state.sizing.fit);
    get_number(root, "scale", state.sizing.scale, 0.125f, 2);
    get_size(root, "fixed", state.sizing.fixed, 0);
    get_size(root, "window", state.size, 320);
    get(root, "maximized", state.maximized);
    get_number(root, "interface_scale", state.interface_scale, 0.5f, 3);
    get(root, "swapped", state.layout.swapped);
    const json places = root.value("tab_places", json::object());
    for (const auto& [tab, name] : places.items()) {
        const auto known = std::find(k_tab_places.begin(), k_tab_places.end(), name.get<std::string>());
        if (known != k_tab_places.end()) state.tab_places[tab] = TabPlace(known - k_tab_places.begin());
    }
    get(root, "left_tab", state.left_tab);
    get(root, "upper_tab", state.upper_tab);
    get(root, "lower_tab", state.lower_tab);
    get(root, "shot", state.shot);
    get(root, "graph", state.graph);
    get_number(root, "fly_speed", state.fly_speed, 0.001f, 1000);
    get_number(root, "path_seconds", state.path_seconds, 0.1f, 600);
    get(root, "closed_passes", state.closed_passes);
    get(root, "coarse_while_moving", state.coarse_while_moving);
    get(root, "capture_folder", state.capture.folder);
    get(root, "capture_frames", state.capture.frames);
    int kind = 0;
    get(root, "capture_kind", kind);
    state.capture.kind = RecordingKind(std::clamp(kind, 0, int(RecordingKind::webm)));
    if (root.contains("bookmarks")) {
        for (const json& value : root.at("bookmarks"))
            state.bookmarks.push_back(bookmark_from(value));
    }
    get(root, "recent_files", state.recent_files);
    if (root.contains("work")) {
        get_work(root.at("work"), "shots", state.work.shots);
        get_work(root.at("work"), "graphs", state.work.graphs);
    }
    return state;
}

} // namespace

WindowState load_window_state() {
    try {
        std::filesystem::path path = state_path();
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return {};
        return state_from(read_json_file(path));
    } catch (const std::exception& error) {
        spdlog::warn("the window's state is ignored: {}", error.what());
        return {};
    }
}

std::string window_state_text(const WindowState& state) {
    json root;
    root["version"] = k_version;
    root["left"] = state.layout.left;
    root["right"] = state.layout.right;
    root["right_split"] = state.layout.right_split;
    root["bottom_height"] = state.layout.bottom_height;
    root["show_bottom"] = state.layout.show_bottom;
    root["bottom_tab"] = state.bottom_tab;
    root["show_left"] = state.layout.show_left;
    root["show_right"] = state.layout.show_right;
    root["fit"] = state.sizing.fit;
    root["scale"] = state.sizing.scale;
    root["fixed"] = {state.sizing.fixed.x, state.sizing.fixed.y};
    root["window"] = {state.size.x, state.size.y};
    root["maximized"] = state.maximized;
    root["interface_scale"] = state.interface_scale;
    root["swapped"] = state.layout.swapped;
    root["tab_places"] = json::object();
    for (const auto& [tab, place] : state.tab_places)
        root["tab_places"][tab] = k_tab_places[size_t(place)];
    root["left_tab"] = state.left_tab;
    root["upper_tab"] = state.upper_tab;
    root["lower_tab"] = state.lower_tab;
    root["shot"] = state.shot;
    root["graph"] = state.graph;
    root["fly_speed"] = state.fly_speed;
    root["path_seconds"] = state.path_seconds;
    root["closed_passes"] = state.closed_passes;
    root["coarse_while_moving"] = state.coarse_while_moving;
    root["capture_folder"] = state.capture.folder;
    root["capture_frames"] = state.capture.frames;
    root["capture_kind"] = int(state.capture.kind);
    root["bookmarks"] = json::array();
    for (const Bookmark& mark : state.bookmarks) {
        root["bookmarks"].push_back({{"shot", mark.shot},
                                     {"name", mark.name},
                                     {"position", vector_json(mark.camera.position)},
                                     {"target", vector_json(mark.camera.target)},
                                     {"up", vector_json(mark.camera.up)},
                                     {"vfov", mark.camera.vfov}});
    }
    root["recent_files"] = state.recent_files;
    root["work"] = {{"shots", work_json(state.work.shots)}, {"graphs", work_json(state.work.graphs)}};
    // Names of files may be no UTF-8: what cannot be written as such is replaced rather than lost with all the rest.
    return json_dump(root, 1) + "\n";
}

void save_window_state(const std::string& text) {
    try {
        write_file_atomically(state_path(), text);
    } catch (const std::exception& error) {
        spdlog::warn("the window's state is not kept: {}", error.what());
    }
}

} // namespace bounce
