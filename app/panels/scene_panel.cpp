// The shot that is shown, what it holds, and its lights and materials to turn at.
#include "app/panels/light_rows.h"
#include "app/panels/material_rows.h"
#include "app/panels/object_rows.h"
#include "app/panels/panel.h"
#include "app/ui/edit.h"
#include "app/ui/keys.h"
#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/open_dialog.h"
#include "app/ui/typed_number.h"
#include "app/ui/widget_rects.h"
#include "core/text.h"
#include "scene/describe.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

namespace bounce {

namespace {

void draw_shots(PanelContext& context) {
    const std::string& shown = context.session.shot().name;
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(k_dim_colour, "shot");
    ImGui::SameLine(ImGui::GetFontSize() * 3);
    ImGui::SetNextItemWidth(-1);
    bool open = ImGui::BeginCombo("##shot", shown.c_str(), ImGuiComboFlags_HeightLarge);
    note_widget("scene.shot");
    if (!open) return;
    for (const std::string& name : asset_names("shots")) {
        if (ImGui::Selectable(name.c_str(), name == shown)) ask_for_shot(context, name);
        note_widget("scene.shot." + name);
    }
    ImGui::EndCombo();
}

void draw_path_entry(PanelContext& context) {
    static std::string path;
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6.2f);
    bool enter = ImGui::InputTextWithHint("##path", "path of a .gltf, .glb, shot or graph", &path,
                                          ImGuiInputTextFlags_EnterReturnsTrue);
    note_widget("scene.path");
    ImGui::SameLine();
    bool pressed = ImGui::Button("open", {ImGui::GetFontSize() * 3, 0});
    help("Files may also be dropped on the window.");
    ImGui::SameLine();
    if (ImGui::Button("…", {-1, 0})) ask_for_open_dialog(context);
    note_widget("scene.browse");
    help(("Folders and what was opened last (" + chord_of(KeyCommand::open_file) + ").").c_str());
    if ((enter || pressed) && !path.empty()) ask_for_file(context, path);
}

void draw_facts(const Session& session) {
    const SceneFacts& facts = session.facts();
    const GpuScene& gpu = session.gpu_scene();
    fact("triangles", "%zu in %zu draws", facts.triangles, facts.instances);
    fact("vertices", "%zu", facts.vertices);
    fact("materials", "%zu: %zu glossy, %zu emissive, %zu masked, %zu blended", facts.materials, facts.glossy_materials,
         facts.emissive_materials, facts.alpha_tested_materials, facts.blended_materials);
    if (facts.textures == 0)
        fact("textures", "none");
    else
        fact("textures", "%zu, %s", facts.textures, format_bytes(double(gpu.texture_bytes())).c_str());
    fact("geometry", "%s", format_bytes(double(gpu.geometry_bytes())).c_str());
    std::vector<std::string> lights;
    auto count = [&](size_t number, const char* what) {
        if (number > 0) lights.push_back(fmt::format("{} {}", number, what));
    };
    count(facts.point_lights, "point");
    count(facts.spot_lights, "spot");
    count(facts.directional_lights, "directional");
    fact("lights", "%s", lights.empty() ? "none is on" : join(lights, ", ").c_str());
    if (facts.dynamic_instances > 0 || facts.animated_lights) {
        fact("moving", "%zu draws%s, %.3g s", facts.dynamic_instances, facts.animated_lights ? " and lights" : "",
             double(facts.animation_duration));
    }
    glm::vec3 size = facts.bounds.size() * float(session.shot().scene.space.unit);
    fact("size", "%.3g × %.3g × %.3g m", double(size.x), double(size.y), double(size.z));
    if (std::string strays = describe_strays(facts); !strays.empty()) show_wrapped(strays, k_warning_colour);
}

void draw_notes(const Session& session) {
    const std::vector<std::string>& notes = session.shot().scene.notes;
    if (notes.empty()) return;
    if (!ImGui::TreeNode("notes", "%zu note%s of the loader", notes.size(), notes.size() == 1 ? "" : "s")) return;
    for (const std::string& note : notes)
        show_wrapped("· " + note, k_warning_colour);
    ImGui::TreePop();
}

void draw_surroundings(PanelContext& context) {
    Session& session = context.session;
    Shot& shot = session.shot();
    auto changed = [&session, &ui = context.ui] {
        session.scene_edited();
        ui.redraw();
    };
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 6);
    glm::vec3 radiance = shot.environment.radiance;
    if (edit_number("environment", radiance, [](glm::vec3& value) {
            return ImGui::ColorEdit3("environment", &value.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
        })) {
        edit(context, "environment", shot.environment.radiance, glm::max(radiance, glm::vec3(0)),
             [&session, changed](const glm::vec3& value) {
                 session.shot().environment.radiance = value;
                 changed();
             });
    }
    note_widget("scene.environment");
    help(shot.environment.map.empty() ? "Radiance from all around, W/(sr·m²)."
                                      : "What the map's radiance is multiplied by.");
    ImGui::PopItemWidth();

    bool diffuse_only = shot.diffuse_only;
    if (ImGui::Checkbox("diffuse only", &diffuse_only)) {
        edit(context, "diffuse only", !diffuse_only, diffuse_only, [&session, changed](bool value) {
            session.shot().diffuse_only = value;
            changed();
        });
    }
    note_widget("scene.diffuse_only");
    help("Every material is Lambert, with base colour · (1 − metallic).");
    ImGui::SameLine();
    bool normal_maps = shot.normal_maps;
    bool any = std::any_of(shot.scene.materials.begin(), shot.scene.materials.end(),
                           [](const Material& material) { return material.normal_texture.texture >= 0; });
    ImGui::BeginDisabled(!any);
    if (ImGui::Checkbox("normal maps", &normal_maps)) {
        edit(context, "normal maps", !normal_maps, normal_maps, [&session, changed](bool value) {
            session.shot().normal_maps = value;
            changed();
        });
    }
    ImGui::EndDisabled();
    help(any ? "Normals from textures, or those of the vertices." : "No material of this scene has a normal map.");
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 8);
    ImGui::BeginDisabled(diffuse_only);
    int model = int(shot.material_model);
    if (ImGui::Combo("material model", &model, "plain\0gltf\0appendix_b\0")) {
        edit(context, "material model", int(shot.material_model), model, [&session, changed](int value) {
            session.shot().material_model = MaterialModel(value);
            changed();
        });
    }
    note_widget("scene.material_model");
    ImGui::EndDisabled();
    help("plain: Lambert + lobe. gltf: appendix B, never brighter than what comes in. appendix_b: without that limit.");
}

} // namespace

void draw_scene_panel(PanelContext& context) {
    Session& session = context.session;
    ImGui::PushID("scene");
    draw_shots(context);
    draw_path_entry(context);
    if (ImGui::CollapsingHeader("Facts", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_facts(session);
        draw_notes(session);
    }
    if (ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_surroundings(context);
        draw_light_rows(context);
    }
    if (!session.shot().object_nodes.empty() && ImGui::CollapsingHeader("Objects", ImGuiTreeNodeFlags_DefaultOpen))
        draw_object_rows(context);
    if (ImGui::CollapsingHeader("Materials")) draw_material_rows(context);
    ImGui::PopID();
}

} // namespace bounce
