#include "app/panels/light_rows.h"

#include "app/ui/edit.h"
#include "app/ui/light_place.h"
#include "app/ui/style.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

const char* const k_types[] = {"point", "spot", "directional"};

bool edit_colour(glm::vec3& colour) {
    return ImGui::ColorEdit3("colour", &colour.x, ImGuiColorEditFlags_Float);
}

class LightRow {
  public:
    LightRow(PanelContext& context, size_t index)
        : context_(context), index_(index), light_(context.session.shot().scene.lights[index]),
          node_(node_of_light(context.session.shot().scene, index)) {
        name_ = light_.name.empty() ? fmt::format("light {}", index + 1) : light_.name;
        if (const auto place = place_of_light(context.session, index)) place_ = *place;
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
        draw_tools();
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

    bool asked_for_copy = false, asked_to_go = false;

  private:
    void draw_tools() {
        int& chosen = context_.ui.chosen_light;
        bool dragged = chosen == int(index_);
        if (ImGui::Checkbox("handles", &dragged)) {
            chosen = dragged ? int(index_) : -1;
            context_.ui.chosen_object = -1;
        }
        note_widget(fmt::format("light.{}.handles", index_));
        help("Shows it in the picture: drag its middle, an axis, the end of its arrow, or the rim of its cone.");
        ImGui::SameLine();
        asked_for_copy = ImGui::SmallButton("duplicate");
        note_widget(fmt::format("light.{}.duplicate", index_));
        ImGui::SameLine();
        asked_to_go = ImGui::SmallButton("delete");
        note_widget(fmt::format("light.{}.delete", index_));
    }

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
        LightPlace after = place_;
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
        move_light(context_, index_, after);
    }

    PanelContext& context_;
    size_t index_;
    Light light_; ///< as it is before this frame's edit
    int node_;
    std::string name_;
    LightPlace place_;
};

} // namespace

static void draw_new_lights(PanelContext& context) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(k_dim_colour, "add");
    for (int type = 0; type < 3; ++type) {
        ImGui::SameLine();
        if (ImGui::SmallButton(k_types[type])) add_light(context, LightType(type));
        note_widget(std::string("lights.add.") + k_types[type]);
        help(type == int(LightType::directional) ? "It shines along the view."
                                                 : "It is placed in front of the camera.");
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("headlight")) add_headlight(context);
    note_widget("lights.add.headlight");
    help("A wide spot at the camera.");
}

void draw_light_rows(PanelContext& context) {
    const Scene& scene = context.session.shot().scene;
    draw_new_lights(context);
    if (scene.lights.empty()) {
        ImGui::TextColored(k_dim_colour, "no point, spot or directional light");
        return;
    }
    int wanted = -1; // rows are drawn to their end before one comes or goes
    bool remove = false;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        ImGui::PushID(int(i));
        LightRow row(context, i);
        row.draw();
        if (row.asked_for_copy || row.asked_to_go) wanted = int(i), remove = row.asked_to_go;
        ImGui::PopID();
    }
    if (wanted >= 0) remove ? delete_light(context, size_t(wanted)) : duplicate_light(context, size_t(wanted));
}

} // namespace bounce
