#include "app/experiments/method_suite.h"

#include "app/experiments/table_file.h"
#include "core/asset_files.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "core/text.h"
#include "graph/graph_file.h"
#include "scene/find_scene.h"
#include "scene/shot.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

namespace {

constexpr int k_max_rungs = 100;

/// Reads the members of one object, and tells about those that are wrong or unknown.
class Members {
  public:
    Members(const ordered_json& json, std::string where, ErrorList& errors)
        : json_(json), where_(std::move(where)), errors_(errors) {
        if (!json_.is_object()) errors_.add(where_ + " must be an object {…}");
    }

    std::string text(const char* key, bool required) {
        known_.push_back(key);
        if (!json_.is_object()) return {};
        return text_at(json_, key, where_, errors_, required);
    }
    void number(const char* key, double least, double most, double& value) {
        if (const ordered_json* found = find(key)) {
            if (found->is_number() && *found >= least && *found <= most)
                value = found->get<double>();
            else
                wrong(key, fmt::format("a number from {} to {}", least, most));
        }
    }
    void whole(const char* key, int least, int most, int& value) {
        double number_read = value;
        number(key, least, most, number_read);
        value = int(number_read);
        if (value != number_read) wrong(key, "a whole number");
    }
    void boolean(const char* key, bool& value) {
        if (const ordered_json* found = find(key)) {
            if (found->is_boolean())
                value = found->get<bool>();
            else
                wrong(key, "true or false");
        }
    }
    void size(const char* key, glm::ivec2& value) {
        if (const ordered_json* found = find(key)) {
            const auto side = [&](size_t i) {
                return found->at(i).is_number_integer() ? found->at(i).get<int64_t>() : int64_t(0);
            };
            const bool pair = found->is_array() && found->size() == 2;
            if (pair && side(0) > 0 && side(1) > 0 && side(0) <= k_max_picture_side && side(1) <= k_max_picture_side)
                value = glm::ivec2(int(side(0)), int(side(1)));
            else
                wrong(key, "[width, height]");
        }
    }
    std::vector<std::string> texts(const char* key) {
        std::vector<std::string> out;
        if (const ordered_json* found = find(key)) {
            if (!found->is_array()) wrong(key, "a list of texts");
            for (const ordered_json& value : *found)
                out.push_back(set_text(value));
        }
        return out;
    }
    const ordered_json& list(const char* key) {
        static const ordered_json none = ordered_json::array();
        const ordered_json* found = find(key);
        if (found && found->is_array() && !found->empty()) return *found;
        wrong(key, "a list of at least one entry");
        return none;
    }
    const ordered_json* find(const char* key) {
        known_.push_back(key);
        return json_.is_object() && json_.contains(key) ? &json_[key] : nullptr;
    }
    void finish() const {
        if (json_.is_object()) check_keys(json_, where_, known_, errors_);
    }

  private:
    void wrong(const char* key, const std::string& expected) {
        errors_.add(fmt::format("{}: invalid '{}': expected {}", where_, key, expected));
    }

    const ordered_json& json_;
    std::string where_;
    ErrorList& errors_;
    std::vector<std::string> known_;
};

MethodScene read_scene(const ordered_json& json, const std::string& where, ErrorList& errors) {
    Members members(json, where, errors);
    MethodScene scene;
    scene.shot = members.text("shot", true);
    scene.required_scene = members.text("requires", false);
    scene.seen = members.text("seen", false);
    members.size("size", scene.size);
    members.size("quick_size", scene.quick_size);
    members.whole("quick_rungs", 0, k_max_rungs, scene.quick_rungs);
    scene.quick_groups = members.texts("quick_groups");
    members.boolean("sky", scene.sky);
    members.boolean("moves", scene.moves);
    members.finish();
    return scene;
}

MethodLadder read_ladder(const ordered_json& json, const std::string& where, ErrorList& errors) {
    Members members(json, where, errors);
    MethodLadder ladder;
    ladder.graph = members.text("graph", true);
    ladder.kind = members.text("kind", true);
    if (ladder.kind != "published" && ladder.kind != "tuned" && ladder.kind != "traced")
        errors.add(fmt::format("{}: invalid kind '{}': expected published, tuned or traced", where, ladder.kind));
    for (const ordered_json& rung : members.list("ladder")) {
        if (!rung.is_object()) {
            errors.add(where + ": a rung of 'ladder' must be {\"pass.parameter\": value}");
            continue;
        }
        ParameterValues& sets = ladder.rungs.emplace_back();
        for (const auto& [name, value] : rung.items())
            sets.emplace_back(name, set_text(value));
    }
    members.finish();
    return ladder;
}

MethodGroup read_group(const ordered_json& json, const std::string& where, ErrorList& errors) {
    Members members(json, where, errors);
    MethodGroup group;
    group.name = members.text("name", true);
    group.title = members.text("title", true);
    group.parts = members.texts("compare");
    if (group.parts.empty()) errors.add(where + ": expected 'compare', a list of parts");
    if (members.find("bounces")) members.whole("bounces", -1, 64, group.bounces.emplace(0));
    if (members.find("diffuse_only")) members.boolean("diffuse_only", group.diffuse_only.emplace(false));
    group.scenes = members.texts("scenes");
    size_t index = 0;
    for (const ordered_json& method : members.list("methods"))
        group.methods.push_back(read_ladder(method, fmt::format("{}, methods[{}]", where, index++), errors));
    members.finish();
    return group;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_there(const std::string& scene) {
    try {
        find_scene(scene, ".");
        return true;
    } catch (const Error&) {
        return false;
    }
}

} // namespace

bool MethodGroup::holds(const ChartPoint& point) const {
    return point.parts == parts && point.task.bounces == bounces && point.task.diffuse_only == diffuse_only &&
           std::any_of(methods.begin(), methods.end(), [&](auto& m) { return m.graph == point.task.session.graph; });
}

std::string MethodSuite::kind_of(const std::string& graph) const {
    for (const MethodGroup& group : groups)
        for (const MethodLadder& method : group.methods)
            if (method.graph == graph) return method.kind;
    return {};
}

std::vector<PointTask> MethodSuite::tasks(bool quick, const std::vector<std::string>& shots,
                                          std::vector<std::string>& skipped) const {
    std::vector<std::string> names;
    for (const MethodScene& scene : scenes)
        names.push_back(scene.shot);
    for (const std::string& shot : shots)
        if (!contains(names, shot)) throw Error("the chart has no scene '" + shot + "'" + did_you_mean(shot, names));
    std::vector<PointTask> tasks;
    for (const MethodScene& scene : scenes) {
        if (!shots.empty() && !contains(shots, scene.shot)) continue;
        if (quick && scene.quick_rungs == 0) continue;
        if (!scene.required_scene.empty() && !is_there(scene.required_scene)) {
            skipped.push_back(
                fmt::format("{}: skipped: {} is not on the scene search path", scene.shot, scene.required_scene));
            continue;
        }
        for (const MethodGroup& group : groups) {
            if (!group.scenes.empty() && !contains(group.scenes, scene.shot)) continue;
            if (quick && !scene.quick_groups.empty() && !contains(scene.quick_groups, group.name)) continue;
            for (const MethodLadder& method : group.methods) {
                const size_t rungs =
                    quick ? std::min(method.rungs.size(), size_t(scene.quick_rungs)) : method.rungs.size();
                for (size_t i = 0; i < rungs; ++i) {
                    PointTask& task = tasks.emplace_back();
                    task.session.shot = scene.shot;
                    task.session.graph = method.graph;
                    task.session.sets = method.rungs[i];
                    task.session.size = quick ? scene.quick_size : scene.size;
                    task.warm_up = warm_up;
                    task.frames = frames;
                    task.reference_noise = quick ? quick_noise : noise;
                    task.parts = group.parts;
                    task.bounces = group.bounces;
                    task.diffuse_only = group.diffuse_only;
                    task.thorough = true;
                }
            }
        }
    }
    return tasks;
}

bool is_method_suite(const std::filesystem::path& path) {
    const auto json = read_json_file<ordered_json>(path);
    return json.is_object() && json.contains("groups");
}

MethodSuite load_method_suite(const std::string& name) {
    const std::filesystem::path path = find_asset("sweeps", "sweep", name);
    const auto json = read_json_file<ordered_json>(path);
    ErrorList errors;
    Members members(json, "the chart", errors);
    MethodSuite suite;
    suite.json = json_dump(json);
    suite.about = members.text("about", false);
    if (const std::string metric = members.text("metric", false); !metric.empty())
        suite.metric = find_metric(metric).name;
    members.whole("warm_up", 0, 1000, suite.warm_up);
    members.whole("frames", 1, 1000, suite.frames);
    members.number("noise", 1e-6, 1, suite.noise);
    members.number("quick_noise", 1e-6, 1, suite.quick_noise);
    size_t index = 0;
    for (const ordered_json& scene : members.list("scenes"))
        suite.scenes.push_back(read_scene(scene, fmt::format("scenes[{}]", index++), errors));
    index = 0;
    for (const ordered_json& group : members.list("groups"))
        suite.groups.push_back(read_group(group, fmt::format("groups[{}]", index++), errors));
    members.finish();
    std::vector<std::string> shots, groups;
    for (const MethodScene& scene : suite.scenes)
        shots.push_back(scene.shot);
    for (const MethodGroup& group : suite.groups) {
        groups.push_back(group.name);
        for (const std::string& scene : group.scenes)
            if (!contains(shots, scene)) errors.add(fmt::format("group {}: there is no scene '{}'", group.name, scene));
    }
    for (const MethodScene& scene : suite.scenes)
        for (const std::string& group : scene.quick_groups)
            if (!contains(groups, group))
                errors.add(fmt::format("scene {}: there is no group '{}'", scene.shot, group));
    errors.throw_if_any(path.string());
    return suite;
}

} // namespace bounce
