#include "app/panels/light_rows.h"

#include "app/ui/edit.h"
#include "app/ui/style.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"
#include "scene/keyframes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

const char* const k_types[] = {"point", "spot", "directional"};

bool edit_colour(glm::vec3& colour) {
    return ImGui::ColorEdit3("colour", &colour.x, ImGuiColorEditFlags_Float);
}

int node_of_light(const Scene& scene, size_t light) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].light == int(light)) return int(i);
    }
    return -1;
}

/// Where a light is and which way it shines, in the file's coordinates.
struct Place {
    glm::dvec3 position{0};
    glm::vec3 direction{0, -1, 0};
};

/// What is not zero by rounding alone would be shown as -0.000.
glm::vec3 clean(glm::vec3 v) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(v[i]) < 1e-6f) v[i] = 0;
    }
    return v;
}

Place place_of(const glm::dmat4& world) {
    return {glm::dvec3(world[3]), clean(glm::vec3(-glm::normalize(glm::dvec3(world[2]))))};
}

/// Moves the node so that its light is there. The parent stays.
void put(Scene& scene, int index, const Place& place, float time) {
    Node& node = scene.nodes[size_t(index)];
    glm::dmat4 parent(1);
    if (node.parent >= 0) parent = file_matrices(scene, time)[size_t(node.parent)];
    glm::dmat4 inverse = glm::inverse(parent);
    node.translation = glm::dvec3(inverse * glm::dvec4(place.position, 1));
    node.rotation = look_rotation(glm::dmat3(inverse) * glm::dvec3(place.direction), true);
    // A light shines the same at any scale.
    node.scale = glm::dvec3(1);
    node.has_matrix = false;
}

class LightRow {
  public:
    LightRow(PanelContext& context, size_t index, const std::vector<glm::dmat4>& worlds)
        : context_(context), index_(index), light_(context.session.shot().scene.lights[index]),
          node_(node_of_light(context.session.shot().scene, index)) {
        name_ = light_.name.empty() ? fmt::format("light {}", index + 1) : light_.name;
        if (node_ >= 0) place_ = place_of(worlds[size_t(node_)]);
    }

    void draw() {
        bool enabled = light_.enabled;
        if (ImGui::Checkbox("##enabled", &enabled)) {
            Light after = light_;
            after.enabled = enabled;
            set(after, "on or off");
        }
        note_widget(fmt::format("light.{}.enabled", index_));
        ImGui::SameLine();
        // One light is what is there to turn at; of many, the one that is wanted is opened.
        ImGuiTreeNodeFlags flags =
            context_.session.shot().scene.lights.size() <= 2 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
        if (!ImGui::TreeNodeEx("light", flags, "%s", name_.c_str())) return;
        ImGui::SameLine();
        ImGui::TextColored(k_dim_colour, "%s", k_types[size_t(light_.type)]);
        ImGui::BeginDisabled(!light_.enabled);
        ImGui::PushItemWidth(-ImGui::GetFontSize() * 5);
        draw_intensity();
        if (light_.type == LightType::spot) draw_cones();
        draw_size();
        draw_place();
        ImGui::PopItemWidth();
        ImGui::EndDisabled();
        ImGui::TreePop();
    }

  private:
    void set(const Light& after, const char* what) {
        Session& session = context_.session;
        edit(context_, name_ + ": " + what, light_, after,
             [&session, &ui = context_.ui, index = index_](const Light& value) {
                 if (index >= session.shot().scene.lights.size()) return;
                 session.shot().scene.lights[index] = value;
                 session.scene_edited();
                 ui.redraw();
             });
    }

    void draw_intensity() {
        // Colour and strength apart: strength is the brightest channel.
        float strength = std::max({light_.intensity.r, light_.intensity.g, light_.intensity.b});
        glm::vec3 colour = strength > 0 ? light_.intensity / strength : glm::vec3(1);
        bool changed = edit_number("intensity", strength, [](float& value) {
            return ImGui::DragFloat("intensity", &value, std::max(value * 0.01f, 0.01f), 0, 1e9f, "%.4g",
                                    ImGuiSliderFlags_AlwaysClamp);
        });
        note_widget(fmt::format("light.{}.intensity", index_));
        help(light_.type == LightType::directional ? "W/m² at normal incidence, of the strongest channel."
                                                   : "W/sr of the strongest channel.");
        changed = edit_number("colour", colour, edit_colour) || changed;
        if (!changed) return;
        Light after = light_;
        // Black keeps a trace of its colour, so that turning the strength up again brings it back.
        after.intensity = glm::clamp(colour, glm::vec3(0), glm::vec3(1)) * std::max(strength, 1e-6f);
        set(after, "intensity");
    }

    void draw_cones() {
        float inner = glm::degrees(light_.inner_cone), outer = glm::degrees(light_.outer_cone);
        bool changed = edit_number("inner cone", inner, [](float& value) {
            return ImGui::SliderFloat("inner cone", &value, 0, 89, "%.1f°", ImGuiSliderFlags_AlwaysClamp);
        });
        bool outer_changed = edit_number("outer cone", outer, [](float& value) {
            return ImGui::SliderFloat("outer cone", &value, 0.5f, 90, "%.1f°", ImGuiSliderFlags_AlwaysClamp);
        });
        note_widget(fmt::format("light.{}.outer_cone", index_));
        help("Half-angles; the inner one stays less than the outer one.");
        if (!changed && !outer_changed) return;
        // Whichever is dragged pushes the other along.
        constexpr float apart = 0.25f;
        if (outer_changed)
            inner = std::min(inner, outer - apart);
        else
            outer = std::max(outer, inner + apart);
        Light after = light_;
        after.inner_cone = glm::radians(std::max(inner, 0.0f));
        after.outer_cone = glm::radians(std::min(outer, 90.0f));
        set(after, "cone");
    }

    void draw_size() {
        bool directional = light_.type == LightType::directional;
        float size = directional ? glm::degrees(light_.angular_radius) : light_.radius;
        bool changed = edit_number("radius", size, [directional](float& value) {
            return directional
                       ? ImGui::DragFloat("radius", &value, 0.02f, 0, 45, "%.3g°", ImGuiSliderFlags_AlwaysClamp)
                       : ImGui::DragFloat("radius", &value, 0.005f, 0, 1e6f, "%.3g m", ImGuiSliderFlags_AlwaysClamp);
        });
        help("Of the light itself: only soft shadows and the reference use it.");
        if (!changed) return;
        Light after = light_;
        (directional ? after.angular_radius : after.radius) = directional ? glm::radians(size) : size;
        set(after, "radius");
    }

    void draw_place() {
        if (node_ < 0) return ImGui::TextColored(k_dim_colour, "no node places it: it shines nowhere");
        const Node& node = context_.session.shot().scene.nodes[size_t(node_)];
        bool driven = node.dynamic;
        ImGui::BeginDisabled(driven);
        Place after = place_;
        bool changed = false;
        float diagonal = std::max(context_.session.facts().bounds.diagonal(), 1e-3f) *
                         float(context_.session.shot().scene.space.unit);
        if (light_.type != LightType::directional) {
            changed = edit_number("position", after.position, [diagonal](glm::dvec3& value) {
                return ImGui::DragScalarN("position", ImGuiDataType_Double, &value.x, 3, 0.002f * diagonal, nullptr,
                                          nullptr, "%.3f");
            });
            note_widget(fmt::format("light.{}.position", index_));
        }
        if (light_.type != LightType::point) {
            changed = edit_number("direction", after.direction,
                                  [](glm::vec3& value) {
                                      return ImGui::DragFloat3("direction", &value.x, 0.005f, -1, 1, "%.3f");
                                  }) ||
                      changed;
            help("The way the light travels.");
        }
        ImGui::EndDisabled();
        if (driven) ImGui::TextColored(k_dim_colour, "a path or an animation moves it");
        if (!changed || driven || glm::length(after.direction) < 1e-4f) return;
        move(after);
    }

    void move(const Place& after) {
        Session& session = context_.session;
        Node before = session.shot().scene.nodes[size_t(node_)], moved = before;
        // Directions are kept as they are typed or dragged, axis by axis; only the node's rotation is of unit length.
        put(session.shot().scene, node_, after, session.time());
        std::swap(moved, session.shot().scene.nodes[size_t(node_)]);
        edit(context_, name_ + ": place", before, moved,
             [&session, &ui = context_.ui, node = size_t(node_)](const Node& value) {
                 if (node >= session.shot().scene.nodes.size()) return;
                 session.shot().scene.nodes[node] = value;
                 session.scene_edited();
                 ui.redraw();
             });
    }

    PanelContext& context_;
    size_t index_;
    Light light_; ///< as it is before this frame's edit
    int node_;
    std::string name_;
    Place place_;
};

} // namespace

void draw_light_rows(PanelContext& context) {
    const Scene& scene = context.session.shot().scene;
    if (scene.lights.empty()) {
        ImGui::TextColored(k_dim_colour, "no point, spot or directional light");
        return;
    }
    std::vector<glm::dmat4> worlds = file_matrices(scene, context.session.time());
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        ImGui::PushID(int(i));
        LightRow(context, i, worlds).draw();
        ImGui::PopID();
    }
}

} // namespace bounce
