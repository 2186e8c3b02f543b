#include "app/panels/object_rows.h"

#include "app/ui/object_place.h"
#include "app/ui/style.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"
#include "scene/turn.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

namespace {

/// Many angles are the same rotation: those that were set are shown as long as they are the object's.
glm::dvec3& shown_angles(size_t object, const glm::dquat& rotation) {
    static std::map<size_t, glm::dvec3> set;
    glm::dvec3& angles = set[object];
    if (std::abs(glm::dot(rotation_of(angles), rotation)) < 1 - 1e-12) angles = angles_of(rotation);
    for (int i = 0; i < 3; ++i)
        if (std::abs(angles[i]) < 1e-9) angles[i] = 0; // not -0.00
    return angles;
}

class ObjectRow {
  public:
    ObjectRow(PanelContext& context, size_t index)
        : context_(context), index_(index), free_(freedom_of_object(context.session.shot(), index)),
          place_(place_of_object(context.session, index)) {}

    void draw() {
        const Shot& shot = context_.session.shot();
        const ImGuiTreeNodeFlags flags = shot.object_nodes.size() <= 2 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
        const bool open = ImGui::TreeNodeEx("object", flags, "%s", name_of_object(shot, index_).c_str());
        note_widget(fmt::format("object.{}", index_));
        if (!open) return;
        int& chosen = context_.ui.chosen_object;
        bool dragged = chosen == int(index_);
        if (ImGui::Checkbox("handles", &dragged)) {
            chosen = dragged ? int(index_) : -1;
            context_.ui.chosen_light = -1;
        }
        note_widget(fmt::format("object.{}.handles", index_));
        help("Shows it in the picture: drag its middle, an axis, or the end of its arrow (its front), which turns it.");
        ImGui::PushItemWidth(-ImGui::GetFontSize() * 5);
        draw_position();
        draw_turn();
        draw_scale();
        ImGui::PopItemWidth();
        if (!free_.move)
            ImGui::TextColored(k_dim_colour, "%s", free_.turn ? "its path moves it" : "its path moves and turns it");
        ImGui::TreePop();
    }

  private:
    void draw_position() {
        const Session& session = context_.session;
        const float diagonal =
            std::max(session.facts().bounds.diagonal(), 1e-3f) * float(session.shot().scene.space.unit);
        ImGui::BeginDisabled(!free_.move);
        ObjectPlace after = place_;
        if (edit_number("position", after.position, [diagonal](glm::dvec3& value) {
                return ImGui::DragScalarN("position", ImGuiDataType_Double, &value.x, 3, 0.002f * diagonal, nullptr,
                                          nullptr, "%.3f");
            }))
            move_object(context_, index_, after);
        ImGui::EndDisabled();
        note_widget(fmt::format("object.{}.position", index_));
        help("In metres, in the coordinates of the shot's file.");
    }

    void draw_turn() {
        ImGui::BeginDisabled(!free_.turn);
        glm::dvec3& angles = shown_angles(index_, place_.rotation);
        if (edit_number("turn", angles, [](glm::dvec3& value) {
                return ImGui::DragScalarN("turn", ImGuiDataType_Double, &value.x, 3, 0.5f, nullptr, nullptr, "%.2f°");
            })) {
            ObjectPlace after = place_;
            after.rotation = rotation_of(angles);
            move_object(context_, index_, after);
        }
        ImGui::EndDisabled();
        note_widget(fmt::format("object.{}.turn", index_));
        help("Degrees about the scene's X, then Y, then Z, as shot files have them.");
    }

    void draw_scale() {
        static bool each = false;
        ObjectPlace after = place_;
        if (edit_number("scale", after.scale, [&](glm::dvec3& value) {
                return ImGui::DragScalarN("scale", ImGuiDataType_Double, &value.x, 3,
                                          float(0.005 * std::abs(place_.scale.x)), nullptr, nullptr, "%.3f");
            })) {
            for (int i = 0; i < 3 && !each; ++i)
                if (after.scale[i] != place_.scale[i]) {
                    const double factor = after.scale[i] / place_.scale[i];
                    for (int j = 0; j < 3; ++j)
                        if (j != i)
                            after.scale[j] =
                                place_.scale[j] == place_.scale[i] ? after.scale[i] : place_.scale[j] * factor;
                    break;
                }
            move_object(context_, index_, after);
        }
        note_widget(fmt::format("object.{}.scale", index_));
        ImGui::SameLine();
        ImGui::Checkbox("##each", &each);
        help("Each axis by itself; else all three are scaled alike.");
    }

    PanelContext& context_;
    size_t index_;
    ObjectFreedom free_;
    ObjectPlace place_; ///< as it is before this frame's edit
};

} // namespace

void draw_object_rows(PanelContext& context) {
    for (size_t i = 0; i < context.session.shot().object_nodes.size(); ++i) {
        ImGui::PushID(int(i));
        ObjectRow(context, i).draw();
        ImGui::PopID();
    }
}

} // namespace bounce
