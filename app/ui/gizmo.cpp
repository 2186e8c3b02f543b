#include "app/ui/gizmo.h"

#include "app/ui/style.h"
#include "app/ui/widget_rects.h"
#include "scene/loaded_space.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bounce {

namespace {

constexpr float k_reach = 9;    // pixels about a handle
constexpr float k_axis = 0.11f; // length of an axis as a share of the distance along the view
constexpr float k_arrow = 1.7f; // length of the arrow, in axes
constexpr float k_rim = 1.3f;   // from the middle to the cone's rim, in axes
constexpr float k_pi = 3.14159265f;

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

/// Where its handles are, in loaded coordinates.
struct Gizmo::Shape {
    View view;
    const LoadedSpace& space;
    glm::vec3 middle;
    float length; ///< of an axis
    bool has_place;
    std::array<glm::vec3, 3> axes;
    glm::vec3 arrow{0}, side{0}; ///< directions: of the arrow, and at right angles to it across the picture
    std::optional<float> cone;
    std::array<glm::vec3, k_handles> ends;
    std::array<bool, k_handles> there;

    /// A point of the cone's rim; turned by `angle` about the arrow, 0: the handle.
    glm::vec3 rim(float angle) const {
        const glm::vec3 across = std::cos(angle) * side + std::sin(angle) * glm::cross(arrow, side);
        return middle + k_rim * length * (std::cos(*cone) * arrow + std::sin(*cone) * across);
    }
    /// The angle between the arrow and where the ray meets the ball of the rim.
    float cone_under(const glm::vec3& ray) const {
        const glm::vec3 now = direction_on_ball(view, middle, k_rim * length, ray, rim(0) - middle);
        return std::acos(std::clamp(glm::dot(now, arrow), -1.0f, 1.0f));
    }
    glm::vec3 place_under(Handle handle, const glm::vec3& ray) const {
        if (handle == k_middle) return view.position + view.depth(middle) * ray;
        return nearest_on_line(middle, axes[size_t(handle - k_x)], view.position, ray);
    }

    Shape(const Session& session, const Area& picture, const GizmoTarget& target)
        : view(session.camera(), picture), space(session.shot().scene.space), has_place(target.position.has_value()),
          cone(target.cone) {
        middle = has_place ? space.to_loaded(*target.position)
                           : view.position + 0.3f * std::max(session.facts().bounds.diagonal(), 1e-3f) * view.forward;
        length = k_axis * view.depth(middle);
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 axis(0);
            axis[i] = 1;
            axes[size_t(i)] = loaded_direction(space, space.to_file(middle), axis);
            ends[size_t(k_x + i)] = middle + length * axes[size_t(i)];
        }
        ends[k_middle] = ends[k_direction] = ends[k_cone] = middle;
        if (target.direction) {
            arrow = loaded_direction(space, space.to_file(middle), glm::dvec3(*target.direction));
            const glm::vec3 across = std::abs(glm::dot(view.right, arrow)) < 0.95f ? view.right : view.up;
            side = glm::normalize(across - glm::dot(across, arrow) * arrow);
            ends[k_direction] = middle + k_arrow * length * arrow;
            if (cone) ends[k_cone] = rim(0);
        }
        there.fill(has_place);
        there[k_direction] = target.direction.has_value();
        there[k_cone] = target.direction && cone;
        for (size_t i = 0; i < k_handles; ++i)
            there[i] = there[i] && view.depth(ends[i]) > 1e-4f;
    }
};

int Gizmo::handle_under(const Shape& shape, const GizmoTarget& target, glm::vec2 mouse) const {
    int under = k_none;
    for (int handle = 0; handle < k_handles; ++handle) {
        const bool can = handle == k_direction ? bool(target.turn)
                         : handle == k_cone    ? bool(target.open)
                                               : bool(target.move);
        const bool near = glm::distance(mouse, shape.view.screen(shape.ends[size_t(handle)])) < k_reach;
        if (can && shape.there[size_t(handle)] && near) under = handle;
    }
    return under;
}

void Gizmo::grab(Handle handle, const Shape& shape, const GizmoTarget& target, const glm::vec3& ray) {
    held_ = handle;
    held_target_ = target;
    if (handle == k_cone)
        grabbed_cone_ = *target.cone - shape.cone_under(ray);
    else if (handle != k_direction)
        grabbed_ = shape.middle - shape.place_under(handle, ray);
}

void Gizmo::drag(const Shape& shape, const glm::vec3& ray) const {
    if (held_ == k_cone) return held_target_.open(std::clamp(shape.cone_under(ray) + grabbed_cone_, 0.0f, 0.5f * k_pi));
    if (held_ != k_direction)
        return held_target_.move(place_in_file(shape.space, shape.place_under(held_, ray) + grabbed_));
    const glm::vec3 now = direction_on_ball(shape.view, shape.middle, k_arrow * shape.length, ray, shape.arrow);
    held_target_.turn(
        glm::vec3(glm::normalize(shape.space.to_file(shape.middle + now) - shape.space.to_file(shape.middle))));
}

void Gizmo::draw_handles(const Shape& shape, int under) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    static const ImU32 colours[] = {IM_COL32(255, 255, 255, 255), IM_COL32(235, 90, 80, 255),
                                    IM_COL32(110, 210, 90, 255),  IM_COL32(90, 140, 245, 255),
                                    IM_COL32(250, 200, 70, 255),  IM_COL32(250, 200, 70, 255)};
    static const char* const names[] = {"gizmo.middle", "gizmo.axis.0",    "gizmo.axis.1",
                                        "gizmo.axis.2", "gizmo.direction", "gizmo.cone"};
    const glm::vec2 from = shape.view.screen(shape.middle);
    if (shape.there[k_cone]) {
        constexpr int k_steps = 48;
        for (int i = 0; i < k_steps; ++i) {
            const glm::vec3 a = shape.rim(2 * k_pi * float(i) / k_steps),
                            b = shape.rim(2 * k_pi * float(i + 1) / k_steps);
            if (shape.view.depth(a) < 1e-4f || shape.view.depth(b) < 1e-4f) continue;
            const glm::vec2 start = shape.view.screen(a), end = shape.view.screen(b);
            list.AddLine({start.x, start.y}, {end.x, end.y}, colours[k_cone], 1.5f);
        }
    }
    for (int handle = k_handles - 1; handle >= 0; --handle) {
        if (!shape.there[size_t(handle)]) continue;
        const glm::vec2 at = shape.view.screen(shape.ends[size_t(handle)]);
        const bool lit = held_ == handle || (held_ == k_none && under == handle);
        if (handle != k_middle) list.AddLine({from.x, from.y}, {at.x, at.y}, colours[handle], lit ? 3.0f : 2.0f);
        list.AddCircleFilled({at.x, at.y}, lit ? 7.0f : 5.0f, colours[handle]);
        list.AddCircle({at.x, at.y}, lit ? 8.0f : 6.0f, IM_COL32(0, 0, 0, 200));
        note(names[handle], at);
    }
}

bool Gizmo::draw(PanelContext& context, const Area& picture, bool hovered, bool pressed, bool held) {
    if (!held) held_ = k_none;
    const std::optional<GizmoTarget> target = gizmo_target(context);
    if (!target) return false;
    const Shape shape(context.session, picture, *target);
    if (shape.view.depth(shape.middle) < 1e-4f) return false;
    if (held_ != k_none && !shape.there[size_t(held_)]) held_ = k_none; // undo chose another light
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 mouse(io.MousePos.x, io.MousePos.y);
    const int under = hovered ? handle_under(shape, *target, mouse) : k_none;
    const glm::vec3 ray = shape.view.ray(mouse);
    if (pressed && under != k_none && ImGui::IsMouseDown(ImGuiMouseButton_Left))
        grab(Handle(under), shape, *target, ray);
    else if (held_ != k_none && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        drag(shape, ray);
    draw_handles(shape, under);
    return held_ != k_none || (under != k_none && !held);
}

} // namespace bounce
