#include "app/ui/light_banner.h"

#include "app/omitted_light.h"
#include "app/ui/edit.h"
#include "app/ui/light_place.h"
#include "app/ui/marks.h"
#include "app/ui/open.h"
#include "app/ui/widget_rects.h"
#include "core/asset_files.h"
#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

/// Whether a pass that needs this is skipped because the scene lacks the light that it carries.
static bool lacks_source(const std::string& needs, const SceneFacts& facts) {
    const auto asks = [&](const char* fact) { return needs.find(fact) != std::string::npos; };
    if (asks("environment") && facts.environment) return false;
    if (asks("emissive_materials") && facts.emissive_materials > 0) return false;
    if (asks("environment") || asks("emissive_materials")) return true;
    return (asks("lights") && facts.lights() == 0) || (asks("glossy_materials") && facts.glossy_materials == 0);
}

/// Parts of the graph's light that nothing makes in this plan, each with the reason of the pass that would.
static std::vector<std::string> unmade_parts(const Session& session) {
    const Plan& plan = session.graph().plan();
    std::vector<std::string> unmade;
    for (const std::string& part : session.graph().model().file().transport.parts) {
        const PlanResource* resource = plan.find_resource(part);
        if (part == "out.radiance" || (resource && !resource->writers.empty())) continue;
        // A pass that was switched off is no riddle; what the scene lacks makes no light either way.
        for (const PlanSkip& skip : plan.skipped) {
            const PassNode* node = session.graph().model().find_node(skip.id);
            if (!node || !node->enabled || skip.reason.starts_with("the scene has no") ||
                lacks_source(node->entry.needs, session.facts()))
                continue;
            const auto& programs = node->programs;
            const bool makes = std::any_of(programs.begin(), programs.end(), [&](const auto& program) {
                const auto& slots = program->slots();
                return std::any_of(slots.begin(), slots.end(),
                                   [&](const ShaderSlot& slot) { return node->target_of(slot.name).resource == part; });
            });
            if (makes) unmade.push_back(fmt::format("no {}: {} is skipped: {}", part.substr(4), skip.id, skip.reason));
        }
    }
    return unmade;
}

std::string missing_light(const Session& session) {
    const SceneFacts& facts = session.facts();
    if (facts.lights() == 0 && facts.emissive_materials == 0 && !facts.environment) return "this shot has no light";
    const GraphFile& file = session.graph().model().file();
    std::vector<std::string> missing;
    if (const auto omitted = omitted_light(file.transport, facts); !omitted.empty())
        missing.push_back(fmt::format("{} leaves out {}", file.name, join(omitted, " and ")));
    for (const std::string& part : unmade_parts(session))
        missing.push_back(part);
    return join(missing, "; ");
}

std::string graph_with_all_light(const Session& session) {
    const GraphFile& now = session.graph().model().file();
    const auto fits = [&](const std::string& name) {
        try {
            const Transport transport = read_graph_file(find_graph(name)).transport;
            return transport.bounces != 0 && name != now.name && omitted_light(transport, session.facts()).empty();
        } catch (const Error&) {
            return false; // told by who opens it
        }
    };
    std::vector<std::string> names = asset_names("graphs");
    // First those of the same method, then any.
    const std::string method = now.name.substr(0, now.name.find('_'));
    std::stable_partition(names.begin(), names.end(), [&](const std::string& n) { return n.starts_with(method); });
    const auto found = std::find_if(names.begin(), names.end(), fits);
    return found == names.end() ? std::string() : *found;
}

void draw_light_banner(PanelContext& context, const Area& area) {
    static std::string asked, text, better, hidden; // found once for a graph and a scene
    const std::string key = fmt::format("{} {} {}", context.session.options().graph, context.session.edits(),
                                        context.session.graph().plans());
    if (asked != key) {
        asked = key;
        text = missing_light(context.session);
        better = text.empty() || text == "this shot has no light" ? "" : graph_with_all_light(context.session);
    }
    if (text.empty() || text == hidden || !area.visible()) return;
    const float margin = ImGui::GetFontSize() * 0.5f;
    ImGui::SetNextWindowPos({area.min.x + margin, area.min.y + area.size.y - margin}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(area.size.x - 2 * margin, 1.0f), area.size.y});
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::Begin("##light", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
    keep_over_picture();
    ImGui::AlignTextToFramePadding();
    show_text(text, k_warning_colour);
    note_widget("banner.text");
    if (!better.empty()) {
        ImGui::SameLine();
        if (ImGui::Button(("open " + better).c_str())) ask_for_graph(context, better);
        note_widget("banner.open");
        show_tooltip("A graph that leaves out no light of this shot.");
    }
    if (text == "this shot has no light") {
        ImGui::SameLine();
        if (ImGui::Button("add a headlight")) add_headlight(context);
        note_widget("banner.headlight");
        show_tooltip("A wide spot at the camera.");
        ImGui::SameLine();
        if (ImGui::Button("add a sky")) {
            Session& session = context.session;
            edit(context, "environment", session.shot().environment.radiance, glm::vec3(1),
                 [&session, &ui = context.ui](const glm::vec3& value) {
                     session.shot().environment.radiance = value;
                     session.scene_edited();
                     ui.redraw();
                 });
        }
        note_widget("banner.sky");
        show_tooltip("Light of radiance 1 from all around.");
    }
    ImGui::SameLine();
    if (ImGui::Button("hide")) hidden = text;
    note_widget("banner.hide");
    ImGui::End();
}

} // namespace bounce
