#include "app/ui/pinned_rays.h"

#include "app/ui/marks.h"
#include "app/ui/widget_rects.h"
#include "ldm/trace_record.h"
#include "lrsm/cone_record.h"
#include "vf/ray_record.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

template <typename T>
bool read(const Buffer* buffer, T& out) {
    if (!buffer || buffer->bytes() < sizeof(T)) return false;
    buffer->read(0, sizeof(T), &out);
    return true;
}

std::optional<PinnedRays> cones_of(const Graph& graph) {
    ConeRecords records{};
    if (!read(graph.buffer("debug.cones"), records) || records.inspected.cones <= 0) return std::nullopt;
    PinnedRays out{"", records.inspected.apex, {}};
    float most = 0;
    const int count = std::min(records.inspected.cones, k_max_recorded_cones);
    for (int i = 0; i < count; ++i)
        most = std::max(most, records.cones[i].weight);
    for (int i = 0; i < count; ++i) {
        const RecordedCone& cone = records.cones[i];
        out.rays.push_back({out.origin + cone.end * cone.direction, most > 0 ? cone.weight / most : 1,
                            cone.occlusion > 0.5f, 0.5f * cone.diameter * cone.end});
    }
    return out;
}

std::optional<PinnedRays> map_rays_of(const Graph& graph, float scene_diagonal) {
    const Buffer* buffer = graph.buffer("debug.rays");
    TracedPixel pixel{};
    if (!read(buffer, pixel) || pixel.rays <= 0) return std::nullopt;
    std::vector<RecordedRay> rays((buffer->bytes() - sizeof pixel) / sizeof(RecordedRay));
    rays.resize(std::min(rays.size(), size_t(pixel.rays)));
    buffer->read(sizeof pixel, rays.size() * sizeof(RecordedRay), rays.data());
    PinnedRays out{"", pixel.x, {}};
    for (const RecordedRay& ray : rays) {
        if (ray.cosine <= 0) continue;
        out.rays.push_back({pixel.x + std::min(ray.distance, scene_diagonal) * ray.direction, std::sqrt(ray.cosine),
                            ray.distance < 1e30f, 0});
    }
    return out;
}

std::optional<PinnedRays> fan_of(const Graph& graph, float scene_diagonal) {
    RecordedFan fan{};
    if (!read(graph.buffer("debug.fan"), fan) || fan.texel.x < 0) return std::nullopt;
    PinnedRays out{"", glm::vec3(fan.origin), {}};
    for (int i = 0; i < std::min(fan.rays, k_max_recorded_rays); ++i) {
        const glm::vec3 direction(fan.ray[i]);
        const float t = fan.ray[i].w;
        if (direction != glm::vec3(0))
            out.rays.push_back({out.origin + (t > 0 ? t : scene_diagonal) * direction, 1, t > 0, 0});
    }
    return out;
}

bool records_rays(const std::string& resource) {
    return resource == "debug.cones_view" || resource == "debug.rays_view" || resource == "debug.vf_fan";
}

/// The part of a segment in front of the camera, in shares of the picture; false: none.
bool project(const glm::mat4& view_projection, const glm::vec3& from, const glm::vec3& to, glm::vec2 ends[2]) {
    glm::vec4 a = view_projection * glm::vec4(from, 1), b = view_projection * glm::vec4(to, 1);
    const float nearest = 1e-4f * std::max(std::abs(a.w), std::abs(b.w)); // a float near 0 is not told from one at 0
    if (std::max(a.w, b.w) <= nearest) return false;
    if (a.w < nearest) a = glm::mix(b, a, (b.w - nearest) / (b.w - a.w));
    if (b.w < nearest) b = glm::mix(a, b, (a.w - nearest) / (a.w - b.w));
    ends[0] = glm::vec2(a) / a.w * 0.5f + 0.5f;
    ends[1] = glm::vec2(b) / b.w * 0.5f + 0.5f;
    return true;
}

} // namespace

std::optional<PinnedRays> recorded_rays(const Graph& graph, const std::string& resource, float scene_diagonal) {
    std::optional<PinnedRays> found;
    if (resource == "debug.cones_view") found = cones_of(graph);
    if (resource == "debug.rays_view") found = map_rays_of(graph, scene_diagonal);
    if (resource == "debug.vf_fan") found = fan_of(graph, scene_diagonal);
    if (found) found->view = resource;
    return found;
}

void draw_pin_buttons(PanelContext& context, const std::string& resource) {
    UiState& ui = context.ui;
    if (records_rays(resource)) {
        ImGui::SameLine();
        if (ImGui::Button("pin rays")) {
            ui.window.ask([&session = context.session, &ui, resource] {
                session.finish_frame();
                auto rays = recorded_rays(session.graph(), resource, session.constants().scene_diagonal);
                if (!rays) return ui.say("there is no surface at the pixel: no rays to pin", true);
                if (!ui.pinned_rays) ui.pinned_rays = std::make_shared<PinnedRayList>();
                ui.say(fmt::format("pinned {} rays", rays->rays.size()));
                ui.pinned_rays->all.push_back(std::move(*rays));
            });
        }
        note_widget("views.pin_rays");
        show_tooltip("Keeps these rays where they are in the scene, so that they can be looked at from elsewhere.");
    }
    if (!ui.pinned_rays || ui.pinned_rays->all.empty()) return;
    ImGui::SameLine();
    if (ImGui::Button(fmt::format("unpin {}###unpin", ui.pinned_rays->all.size()).c_str())) ui.pinned_rays->all.clear();
    note_widget("views.unpin_rays");
}

void draw_pinned_rays(const PanelContext& context, const Area& picture) {
    if (!context.ui.pinned_rays || context.ui.pinned_rays->all.empty()) return;
    FrameConstants view;
    set_camera(view, context.session.camera(), context.session.size(), 1);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(picture.min, {picture.min.x + picture.size.x, picture.min.y + picture.size.y}, true);
    const auto on_screen = [&](glm::vec2 share) {
        return ImVec2(picture.min.x + share.x * picture.size.x, picture.min.y + share.y * picture.size.y);
    };
    for (const PinnedRays& pinned : context.ui.pinned_rays->all) {
        for (const PinnedRay& ray : pinned.rays) {
            glm::vec2 ends[2];
            if (!project(view.view_projection, pinned.origin, ray.end, ends)) continue;
            const int alpha = int(60 + 160 * std::clamp(ray.strength, 0.0f, 1.0f));
            const ImU32 colour = ray.hits ? IM_COL32(255, 150, 40, alpha) : IM_COL32(80, 160, 255, alpha);
            list.AddLine(on_screen(ends[0]), on_screen(ends[1]), colour, 1.2f);
            if (ray.hits) list.AddCircleFilled(on_screen(ends[1]), 2.5f, colour);
            glm::vec2 rim[2];
            const glm::vec3 beside = ray.end + ray.radius * view.camera_right;
            if (ray.radius <= 0 || !project(view.view_projection, ray.end, beside, rim)) continue;
            const ImVec2 middle = on_screen(rim[0]), edge = on_screen(rim[1]);
            list.AddCircle(middle, std::hypot(edge.x - middle.x, edge.y - middle.y), colour);
        }
        glm::vec2 origin[2];
        if (project(view.view_projection, pinned.origin, pinned.origin, origin))
            list.AddCircleFilled(on_screen(origin[0]), 3.5f, IM_COL32(255, 255, 60, 255));
    }
    list.PopClipRect();
}

} // namespace bounce
