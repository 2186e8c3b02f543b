#include "app/panels/material_rows.h"

#include "app/ui/edit.h"
#include "app/ui/style.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui_stdlib.h>

namespace bounce {

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string name_of(const Material& material, size_t index) {
    return material.name.empty() ? fmt::format("material {}", index + 1) : material.name;
}

auto edit_colour(const char* label) {
    return [label](glm::vec3& colour) { return ImGui::ColorEdit3(label, &colour.x, ImGuiColorEditFlags_Float); };
}

auto edit_share(const char* label) {
    return
        [label](float& value) { return ImGui::SliderFloat(label, &value, 0, 1, "%.3f", ImGuiSliderFlags_AlwaysClamp); };
}

void draw_emission(Material& after, bool& changed) {
    // Colour and strength apart, as for lights.
    float strength = std::max({after.emission.r, after.emission.g, after.emission.b});
    glm::vec3 colour = strength > 0 ? after.emission / strength : glm::vec3(1);
    bool now = edit_number("emission", strength, [](float& value) {
        return ImGui::DragFloat("emission", &value, std::max(value * 0.01f, 0.01f), 0, 1e7f, "%.4g",
                                ImGuiSliderFlags_AlwaysClamp);
    });
    help("Radiance of the strongest channel, W/(sr·m²).");
    if (strength > 0) now = edit_number("emitted", colour, edit_colour("emitted")) || now;
    if (now) after.emission = strength > 0 ? glm::clamp(colour, glm::vec3(0), glm::vec3(1)) * strength : glm::vec3(0);
    changed = changed || now;
}

void draw_material(PanelContext& context, size_t index) {
    Session& session = context.session;
    const Material before = session.shot().scene.materials[index];
    Material after = before;
    bool changed = false;
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 5.5f);
    glm::vec3 base(after.base_colour);
    if (edit_number("base colour", base, edit_colour("base colour"))) {
        after.base_colour = glm::vec4(base, after.base_colour.a);
        changed = true;
    }
    note_widget(fmt::format("material.{}.base_colour", index));
    if (before.base_colour_texture.texture >= 0) help("Multiplies the texture.");
    changed = edit_number("metallic", after.metallic, edit_share("metallic")) || changed;
    if (before.metallic_roughness_texture.texture >= 0) help("Multiplies the texture.");
    changed = edit_number("roughness", after.roughness, edit_share("roughness")) || changed;
    help("Perceptual; α is its square.");
    draw_emission(after, changed);
    ImGui::PopItemWidth();
    const Material& opened =
        index < context.ui.window.opened.materials.size() ? context.ui.window.opened.materials[index] : before;
    bool differs = opened.base_colour != before.base_colour || opened.metallic != before.metallic ||
                   opened.roughness != before.roughness || opened.emission != before.emission;
    if (differs && ImGui::SmallButton("as in the file")) {
        after = opened;
        changed = true;
    }
    if (!changed) return;
    edit(context, name_of(before, index), before, after, [&session, &ui = context.ui, index](const Material& value) {
        if (index >= session.shot().scene.materials.size()) return;
        session.shot().scene.materials[index] = value;
        session.scene_edited();
        ui.redraw();
    });
}

} // namespace

void draw_material_rows(PanelContext& context) {
    static std::string filter;
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "part of a name", &filter);
    const std::vector<Material>& materials = context.session.shot().scene.materials;
    size_t shown = 0;
    for (size_t i = 0; i < materials.size(); ++i) {
        std::string name = name_of(materials[i], i);
        if (!filter.empty() && lower(name).find(lower(filter)) == std::string::npos) continue;
        ++shown;
        ImGui::PushID(int(i));
        const glm::vec4& base = materials[i].base_colour;
        float side = ImGui::GetTextLineHeight();
        ImGui::ColorButton("##swatch", {base.r, base.g, base.b, 1},
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
        ImGui::SameLine();
        if (ImGui::TreeNode("material", "%s%s", name.c_str(), materials[i].is_emissive() ? "  (emits)" : "")) {
            draw_material(context, i);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (shown == 0) ImGui::TextColored(k_dim_colour, "no material is named so");
}

} // namespace bounce
