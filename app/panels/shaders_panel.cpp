// Programs and what is wrong with them.
#include "app/panels/panel.h"
#include "app/panels/shader_errors.h"
#include "app/ui/marks.h"
#include "app/ui/widget_rects.h"
#include "core/paths.h"

#include <fmt/format.h>

namespace bounce {

std::vector<GraphProblem> shader_problems(const Graph& graph) {
    std::vector<GraphProblem> problems = graph.problems();
    std::erase_if(problems, [](const GraphProblem& problem) { return !problem.where.starts_with("pass "); });
    return problems;
}

int shader_error_count(const Graph& graph) {
    return int(shader_problems(graph).size());
}

ProgramState program_state(const Program& program) {
    if (program.disabled()) return ProgramState::disabled;
    if (!program.errors().empty()) return program.usable() ? ProgramState::old_text : ProgramState::failed;
    return program.usable() ? ProgramState::good : ProgramState::not_compiled;
}

namespace {

void draw_state(ProgramState state) {
    switch (state) {
    case ProgramState::good:
        show_text("good", k_good_colour);
        break;
    case ProgramState::not_compiled:
        show_text("not compiled", k_dim_colour);
        show_tooltip("Its pass does not run.");
        break;
    case ProgramState::old_text:
        show_text("failed, last good runs", k_warning_colour);
        show_tooltip("The text is wrong: the program that was good last runs in its place.");
        break;
    case ProgramState::failed:
        show_text("failed, not running", k_error_colour);
        show_tooltip("There never was a good program: the pass is skipped, its colours are magenta.");
        break;
    case ProgramState::disabled:
        show_text("disabled after a GPU reset", k_error_colour);
        show_tooltip("It comes back when its text changes.");
        break;
    }
}

std::string place_of(const ShaderError& error) {
    return error.line > 0 ? fmt::format("{}:{}", error.file.string(), error.line) : error.file.string();
}

void copy(UiState& ui, const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    ui.say("copied: " + text.substr(0, text.find('\n')));
}

void draw_error(PanelContext& context, const GraphProblem& problem, int number) {
    const ShaderError& error = problem.error;
    std::string place = place_of(error);
    ImGui::PushID(number);
    ImGui::BeginGroup();
    if (ImGui::SmallButton("copy")) copy(context.ui, error.text());
    note_widget(fmt::format("shaders.copy.{}", number));
    show_tooltip("Copies the place, the line and the message.");
    ImGui::SameLine();
    show_text(place, k_error_colour);
    if (ImGui::IsItemClicked()) copy(context.ui, place);
    show_tooltip(problem.where + "\nClick to copy " + place + " for your editor.");
    ImGui::SameLine();
    show_text(problem.where, k_dim_colour);
    ImGui::Indent();
    if (!error.source_line.empty()) show_wrapped(error.source_line, ImGui::GetStyleColorVec4(ImGuiCol_Text));
    show_wrapped(error.message, k_warning_colour);
    ImGui::Unindent();
    ImGui::EndGroup();
    note_widget(fmt::format("shaders.error.{}", number));
    ImGui::Separator();
    ImGui::PopID();
}

std::string shown_path(const std::filesystem::path& file) {
    std::filesystem::path inside = file.lexically_relative(glsl_folder());
    return inside.empty() || *inside.begin() == ".." ? file.string() : inside.string();
}

void draw_program(PanelContext& context, const PassNode& node, const Program& program) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    std::string name = node.id();
    if (node.programs.size() > 1) name += "." + program.name();
    ImGui::PushID(name.c_str());
    bool open = ImGui::TreeNodeEx("##files", ImGuiTreeNodeFlags_SpanFullWidth, "%s", name.c_str());
    note_widget("shaders.program." + name);
    ImGui::TableNextColumn();
    draw_state(program_state(program));
    if (open) {
        for (const std::filesystem::path& file : program.files()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            if (ImGui::Selectable(shown_path(file).c_str(), false, ImGuiSelectableFlags_SpanAllColumns))
                copy(context.ui, file.string());
            show_tooltip(file.string() + "\nClick to copy the path.");
        }
        ImGui::TreePop();
    }
    ImGui::PopID();
}

} // namespace

void draw_shaders_panel(PanelContext& context) {
    const Graph& graph = context.session.graph();
    std::vector<GraphProblem> problems = shader_problems(graph);
    if (problems.empty()) {
        show_text("no errors", k_good_colour);
    } else {
        show_text(fmt::format("{} error{}", problems.size(), problems.size() == 1 ? "" : "s"), k_error_colour);
        ImGui::SameLine();
        show_text("the last good programs run", k_dim_colour);
    }
    note_widget("shaders.count");
    ImGui::Separator();
    for (size_t i = 0; i < problems.size(); ++i)
        draw_error(context, problems[i], int(i));

    if (!ImGui::BeginTable("programs", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("program and its files", ImGuiTableColumnFlags_WidthStretch, 3);
    ImGui::TableSetupColumn("state", ImGuiTableColumnFlags_WidthStretch, 2);
    ImGui::TableHeadersRow();
    for (const auto& node : graph.model().nodes()) {
        for (const auto& program : node->programs)
            draw_program(context, *node, *program);
    }
    ImGui::EndTable();
}

} // namespace bounce
