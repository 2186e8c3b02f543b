#include "app/ui/style.h"

#include "core/paths.h"

#include <cstdarg>
#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

namespace fs = std::filesystem;

namespace {

ImFont* fixed = nullptr;
float unit = 1;

std::string first_of(const std::vector<std::string>& names) {
    std::vector<fs::path> folders = {root_folder() / "fonts"};
    for (const char* folder :
         {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/TTF", "/usr/share/fonts/dejavu-sans-fonts",
          "/usr/share/fonts/dejavu-sans-mono-fonts", "/usr/share/fonts/dejavu", "/usr/share/fonts/truetype/noto",
          "/usr/share/fonts/noto", "/usr/share/fonts/truetype/liberation", "/usr/share/fonts/liberation"}) {
        folders.emplace_back(folder);
    }
    std::error_code ignored;
    for (const std::string& name : names) {
        for (const fs::path& folder : folders) {
            if (fs::is_regular_file(folder / name, ignored)) return (folder / name).string();
        }
    }
    return {};
}

ImFont* load(const std::vector<std::string>& names, float pixels) {
    // Latin, Greek, punctuation, super- and subscripts, arrows, operators, shapes.
    static const ImWchar ranges[] = {0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2070, 0x209f,
                                     0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
    std::string file = first_of(names);
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    if (ImFont* font = file.empty() ? nullptr : atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, ranges))
        return font;
    ImFontConfig plain;
    plain.SizePixels = pixels;
    return atlas.AddFontDefault(&plain);
}

} // namespace

void load_fonts(float scale, float pixel_ratio) {
    ImGui::GetIO().Fonts->Clear();
    load({"DejaVuSans.ttf", "NotoSans-Regular.ttf", "LiberationSans-Regular.ttf"},
         float(int(14 * scale * pixel_ratio + 0.5f)));
    fixed = load({"DejaVuSansMono.ttf", "NotoSansMono-Regular.ttf", "LiberationMono-Regular.ttf"},
                 float(int(13 * scale * pixel_ratio + 0.5f)));
    ImGui::GetIO().FontGlobalScale = 1 / pixel_ratio;
}

ImFont* fixed_font() {
    return fixed ? fixed : ImGui::GetFont();
}

float interface_scale() {
    return unit;
}

void apply_style(float scale) {
    unit = scale;
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    style.WindowPadding = {8, 7};
    style.FramePadding = {6, 3};
    style.ItemSpacing = {7, 5};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.TabRounding = 3;
    style.ScrollbarRounding = 3;
    style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.FrameBorderSize = 0;
    style.PopupBorderSize = 1;
    style.ScaleAllSizes(scale);

    auto grey = [](float value, float alpha = 1) { return ImVec4(value, value, value * 1.01f, alpha); };
    auto accent = [](float alpha) { return ImVec4(k_accent_colour.x, k_accent_colour.y, k_accent_colour.z, alpha); };
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = grey(0.89f);
    c[ImGuiCol_TextDisabled] = grey(0.55f);
    c[ImGuiCol_WindowBg] = grey(0.135f);
    c[ImGuiCol_ChildBg] = grey(0, 0);
    c[ImGuiCol_PopupBg] = grey(0.11f, 0.98f);
    c[ImGuiCol_Border] = grey(0.28f);
    c[ImGuiCol_FrameBg] = grey(0.21f);
    c[ImGuiCol_FrameBgHovered] = grey(0.27f);
    c[ImGuiCol_FrameBgActive] = grey(0.30f);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.30f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.38f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.45f);
    c[ImGuiCol_CheckMark] = accent(1);
    c[ImGuiCol_SliderGrab] = accent(0.85f);
    c[ImGuiCol_SliderGrabActive] = accent(1);
    c[ImGuiCol_Button] = grey(0.25f);
    c[ImGuiCol_ButtonHovered] = grey(0.32f);
    c[ImGuiCol_ButtonActive] = accent(0.7f);
    c[ImGuiCol_Header] = grey(0.22f);
    c[ImGuiCol_HeaderHovered] = grey(0.28f);
    c[ImGuiCol_HeaderActive] = accent(0.45f);
    c[ImGuiCol_Separator] = grey(0.25f);
    c[ImGuiCol_SeparatorHovered] = accent(0.7f);
    c[ImGuiCol_SeparatorActive] = accent(1);
    c[ImGuiCol_Tab] = grey(0.17f);
    c[ImGuiCol_TabHovered] = grey(0.32f);
    c[ImGuiCol_TabActive] = grey(0.27f);
    c[ImGuiCol_TabUnfocused] = c[ImGuiCol_Tab];
    c[ImGuiCol_TabUnfocusedActive] = c[ImGuiCol_TabActive];
    c[ImGuiCol_PlotLines] = accent(0.9f);
    c[ImGuiCol_PlotHistogram] = accent(0.75f);
    c[ImGuiCol_TextSelectedBg] = accent(0.35f);
    c[ImGuiCol_TitleBg] = grey(0.17f);
    c[ImGuiCol_TitleBgActive] = grey(0.22f);
    c[ImGuiCol_NavHighlight] = accent(0.8f);
    c[ImGuiCol_TableHeaderBg] = grey(0.19f);
    c[ImGuiCol_TableBorderStrong] = grey(0.25f);
    c[ImGuiCol_TableBorderLight] = grey(0.20f);
    c[ImGuiCol_TableRowBgAlt] = grey(1, 0.025f);
}

void help(const char* text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void fact(const char* name, const char* format, ...) {
    ImGui::TextColored(k_dim_colour, "%s", name);
    ImGui::SameLine(ImGui::GetFontSize() * 5.6f);
    ImGui::PushTextWrapPos(0);
    va_list arguments;
    va_start(arguments, format);
    ImGui::TextV(format, arguments);
    va_end(arguments);
    ImGui::PopTextWrapPos();
}

} // namespace bounce
