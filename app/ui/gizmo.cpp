#include "app/ui/light_gizmo.h"

#include "app/ui/light_place.h"
#include "app/ui/style.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bounce {

namespace {

constexpr float k_reach = 9;    // pixels about a handle
constexpr float k_axis = 0.11f; // length of an axis as a share of the distance along the view
constexpr float k_arrow = 1.7f; // length of the arrow, in axes

/// Between places in the scene (loaded coordinates) and on the screen.
struct View {
    glm::vec3 position, forward, right, up;
    glm::vec2 slope; ///< of the picture's right and upper edge
    glm::vec2 min, size;

    View(const Camera& camera, const Area& picture)
        : position(camera.position), forward(glm::normalize(camera.target - camera.position)),
          right(glm::normalize(glm::cross(forward, camera.up))), up(glm::cross(right, forward)),
          min(picture.min.x, picture.min.y), size(picture.size.x, picture.size.y) {
        const float tangent = std::tan(0.5f * camera.vfov);
        slope = {tangent * size.x / size.y, tangent};
    }
    float depth(const glm::vec3& p) const { return glm::dot(p - position, forward); }
    glm::vec2 screen(const glm::vec3& p) const {
        const glm::vec3 d = p - position;
        const glm::vec2 at = glm::vec2(glm::dot(d, right), -glm::dot(d, up)) / (depth(p) * slope);
        return min + (0.5f * at + 0.5f) * size;
    }
    /// Of length 1 along the view.
    glm::vec3 ray(glm::vec2 at) const {
        const glm::vec2 share = 2.0f * (at - min) / size - 1.0f;
        return forward + share.x * slope.x * right - share.y * slope.y * up;
    }
};

glm::vec3 loaded_direction(const LoadedSpace& space, const glm::dvec3& at, const glm::dvec3& direction) {
    return glm::normalize(space.to_loaded(at + direction) - space.to_loaded(at));
}

/// The point of a line nearest to a ray.
glm::vec3 nearest_on_line(const glm::vec3& at, const glm::vec3& along, const glm::vec3& origin, const glm::vec3& ray) {
    const glm::vec3 between = at - origin;
    const float rr = glm::dot(ray, ray), ar = glm::dot(along, ray), aa = glm::dot(along, along);
    const float below = rr * aa - ar * ar;
    if (below < 1e-9f) return at; // the axis points at the camera
    return at + along * ((ar * glm::dot(ray, between) - rr * glm::dot(along, between)) / below);
}

/// The direction from `middle` to where the ray meets a ball about it: the side on which `before` is.
glm::vec3 direction_on_ball(const View& view, const glm::vec3& middle, float radius, const glm::vec3& ray,
                            const glm::vec3& before) {
    const glm::vec3 unit = glm::normalize(ray), from = view.position - middle;
    const float b = glm::dot(from, unit), c = glm::dot(from, from) - radius * radius, d = b * b - c;
    if (d <= 0) return glm::normalize(from - b * unit); // beside it: its rim
    const bool behind = glm::dot(before, view.forward) > 0;
    return glm::normalize(from + (-b + (behind ? 1.0f : -1.0f) * std::sqrt(d)) * unit);
}

void note(const char* name, glm::vec2 at) {
    note_rectangle(name, at.x - 4, at.y - 4, at.x + 4, at.y + 4);
}

} // namespace

bool LightGizmo::draw(PanelContext& context, const Area& picture, bool hovered, bool pressed, bool held) {
    Session& session = context.session;
    const int chosen = context.ui.chosen_light;
    if (!held) held_ = k_none;
    if (chosen < 0 || chosen >= int(session.shot().scene.lights.size())) return false;
    const std::optional<LightPlace> place = place_of_light(session, size_t(chosen));
    if (!place) return false;
    const Light& light = session.shot().scene.lights[size_t(chosen)];
    const LoadedSpace& space = session.shot().scene.space;
    const View view(session.camera(), picture);
    const bool has_place = light.type != LightType::directional, has_direction = light.type != LightType::point;
    // What has no place is shown in the middle of the view.
    const glm::vec3 middle =
        has_place ? space.to_loaded(place->position)
                  : view.position + 0.3f * std::max(session.facts().bounds.diagonal(), 1e-3f) * view.forward;
    if (view.depth(middle) < 1e-4f) return false;
    const float length = k_axis * view.depth(middle);
    std::array<glm::vec3, 3> axes;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0);
        axis[i] = 1;
        axes[size_t(i)] = loaded_direction(space, space.to_file(middle), axis);
    }
    const glm::vec3 shines = loaded_direction(space, space.to_file(middle), glm::dvec3(place->direction));
    std::array<glm::vec3, k_handles> ends{middle, middle + length * axes[0], middle + length * axes[1],
                                          middle + length * axes[2], middle + k_arrow * length * shines};
    const auto there = [&](int handle) {
        return (handle == k_direction ? has_direction : has_place) && view.depth(ends[size_t(handle)]) > 1e-4f;
    };

    const glm::vec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    int under = k_none;
    for (int handle = 0; hovered && handle < k_handles; ++handle)
        if (there(handle) && glm::distance(mouse, view.screen(ends[size_t(handle)])) < k_reach) under = handle;
    const glm::vec3 ray = view.ray(mouse);
    if (pressed && under != k_none && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        held_ = Handle(under);
        const glm::vec3 at = held_ == k_middle ? view.position + view.depth(middle) * ray
                             : held_ < k_direction
                                 ? nearest_on_line(middle, axes[size_t(held_ - k_x)], view.position, ray)
                                 : middle;
        grabbed_ = middle - at;
    } else if (held_ != k_none && (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0)) {
        LightPlace moved = *place;
        if (held_ == k_direction) {
            const glm::vec3 now = direction_on_ball(view, middle, k_arrow * length, ray, shines);
            moved.direction = glm::vec3(glm::normalize(space.to_file(middle + now) - space.to_file(middle)));
        } else {
            glm::vec3 at = view.position + view.depth(middle) * ray;
            if (held_ != k_middle) at = nearest_on_line(middle, axes[size_t(held_ - k_x)], view.position, ray);
            moved.position = space.to_file(at + grabbed_);
        }
        move_light(context, size_t(chosen), moved);
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    static const ImU32 colours[] = {IM_COL32(255, 255, 255, 255), IM_COL32(235, 90, 80, 255),
                                    IM_COL32(110, 210, 90, 255), IM_COL32(90, 140, 245, 255),
                                    IM_COL32(250, 200, 70, 255)};
    static const char* const names[] = {"gizmo.middle", "gizmo.axis.0", "gizmo.axis.1", "gizmo.axis.2",
                                        "gizmo.direction"};
    const glm::vec2 from = view.screen(middle);
    for (int handle = k_handles - 1; handle >= 0; --handle) {
        if (!there(handle)) continue;
        const glm::vec2 at = view.screen(ends[size_t(handle)]);
        const bool lit = held_ == handle || (held_ == k_none && under == handle);
        if (handle != k_middle) list.AddLine({from.x, from.y}, {at.x, at.y}, colours[handle], lit ? 3.0f : 2.0f);
        list.AddCircleFilled({at.x, at.y}, lit ? 7.0f : 5.0f, colours[handle]);
        list.AddCircle({at.x, at.y}, lit ? 8.0f : 6.0f, IM_COL32(0, 0, 0, 200));
        note(names[handle], at);
    }
    return held_ != k_none || (under != k_none && !held);
}

} // namespace bounce
