#include "app/ui/camera_path.h"

#include "app/ui/keys.h"
#include "app/ui/shot_writer.h"
#include "scene/loaded_space.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

/// Between p1 (s = 0) and p2 (s = 1).
glm::dvec3 catmull_rom(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2, const glm::dvec3& p3,
                       double s) {
    return p1 + 0.5 * s * (p2 - p0 + s * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + s * (3.0 * (p1 - p2) + p3 - p0)));
}

/// The first and the last part go on straight beyond their ends.
glm::dvec3 spline(const std::vector<glm::dvec3>& points, size_t part, double s) {
    const glm::dvec3 &p1 = points[part], &p2 = points[part + 1];
    const glm::dvec3 p0 = part > 0 ? points[part - 1] : 2.0 * p1 - p2;
    const glm::dvec3 p3 = part + 2 < points.size() ? points[part + 2] : 2.0 * p2 - p1;
    return s == 0 ? p1 : s == 1 ? p2 : catmull_rom(p0, p1, p2, p3, s);
}

struct PathOfShot {
    Path path;
    Camera camera;
};

void change_path(PanelContext& context, const std::string& what, const PathOfShot& after) {
    Session& session = context.session;
    const PathOfShot before{session.shot().camera_path, session.shot().camera};
    const auto set = [&session, &ui = context.ui](const PathOfShot& value) {
        session.shot().camera_path = value.path;
        session.shot().camera = value.camera;
        session.scene_edited();
        if (!session.camera_is_set()) session.follow_shot_camera(); // it jumps
        ui.redraw();
    };
    set(after);
    context.undo.push({what, [set, before] { set(before); }, [set, after] { set(after); }});
}

} // namespace

Path path_through(const std::vector<Camera>& cameras, const LoadedSpace& space, float start, float seconds, float fps) {
    constexpr int k_max_steps = 24;
    std::vector<glm::dvec3> positions, targets;
    for (const Camera& camera : cameras) {
        positions.push_back(place_in_file(space, camera.position));
        targets.push_back(place_in_file(space, camera.target));
    }
    const int steps = int(std::clamp(std::round(seconds * fps), 1.0f, float(k_max_steps)));
    Path path;
    glm::dvec3 ahead = targets.front() - positions.front();
    for (size_t part = 0; part + 1 < cameras.size(); ++part)
        for (int i = part == 0 ? 0 : 1; i <= steps; ++i) {
            const double s = double(i) / steps;
            PathKey key;
            key.t = float(double(start) + (double(part) + s) * double(seconds));
            key.position = place_in_file(space, space.to_loaded(spline(positions, part, s)));
            key.target = place_in_file(space, space.to_loaded(spline(targets, part, s)));
            key.has_target = true;
            // Where it would look at itself it goes on looking as before.
            if (glm::distance(key.position, key.target) < 1e-6 * glm::length(ahead)) key.target = key.position + ahead;
            ahead = key.target - key.position;
            if (path.empty() || key.t > path.keys.back().t) path.keys.push_back(key);
        }
    return path;
}

std::vector<Bookmark> bookmarks_of(const WindowState& window, const Session& session) {
    std::vector<Bookmark> out;
    for (const Bookmark& mark : window.bookmarks)
        if (mark.shot == session.options().shot) out.push_back(mark);
    return out;
}

void make_camera_path(PanelContext& context) {
    Session& session = context.session;
    WindowState& window = context.ui.window;
    const std::vector<Bookmark> marks = bookmarks_of(window, session);
    if (marks.size() < 2) return context.ui.say("a path needs two bookmarks of this shot; B makes one", true);
    std::vector<Camera> cameras;
    for (const Bookmark& mark : marks)
        cameras.push_back(mark.camera);
    const Shot& shot = session.shot();
    PathOfShot after{path_through(cameras, shot.scene.space, shot.time, window.path_seconds, shot.fps), shot.camera};
    after.camera.up = cameras.front().up;
    after.camera.vfov = cameras.front().vfov;
    session.follow_shot_camera();
    session.set_frame(0);
    if (context.ui.note_camera) context.ui.note_camera(); // a step of its own, below that of the path
    change_path(context, "camera path", after);
    const float seconds = window.path_seconds * float(marks.size() - 1);
    window.capture.frames = int(std::clamp(std::round(seconds * shot.fps), 1.0f, 999999.0f)) + 1;
    context.ui.say(fmt::format("a path of {:g} s through {} bookmarks: {} plays it, {} records it, {} drops it",
                               seconds, marks.size(), chord_of(KeyCommand::play), chord_of(KeyCommand::record),
                               chord_of(KeyCommand::shot_camera)));
}

void go_to_shot_camera(PanelContext& context) {
    Session& session = context.session;
    const SceneBaseline& opened = context.ui.window.opened;
    session.follow_shot_camera();
    context.ui.redraw();
    if (!camera_path_edited(session.shot(), opened)) return;
    if (context.ui.note_camera) context.ui.note_camera();
    change_path(context, "drop the camera path", {opened.camera_path, opened.camera});
    context.ui.say("the shot's own camera; " + chord_of(KeyCommand::undo) + " brings the path back");
}

} // namespace bounce
