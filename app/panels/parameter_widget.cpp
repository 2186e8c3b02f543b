#include "app/panels/parameter_widget.h"

#include "app/ui/widget_rects.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <imgui.h>

namespace bounce {

bool has_logarithmic_slider(const ParameterInfo& info) {
    return info.min > 0 && std::isfinite(info.max) && info.max > 1000 * info.min;
}

/// ImGui rounds what a person drags to the digits shown, so values stay short enough to type.
static constexpr const char* k_number = "%.4g";

static bool has_range(const ParameterInfo& info) {
    return std::isfinite(info.min) && std::isfinite(info.max);
}

static bool draw_reals(const ParameterInfo& info, float* values, int count) {
    float min = float(std::max(info.min, -double(FLT_MAX))), max = float(std::min(info.max, double(FLT_MAX)));
    ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    if (has_range(info) && info.max - info.min < 1e6) {
        if (has_logarithmic_slider(info)) flags |= ImGuiSliderFlags_Logarithmic;
        return ImGui::SliderScalarN("##value", ImGuiDataType_Float, values, count, &min, &max, k_number, flags);
    }
    float largest = 0;
    for (int i = 0; i < count; ++i)
        largest = std::max(largest, std::abs(values[i]));
    float speed = std::max(largest, 0.1f) * 0.01f;
    return ImGui::DragScalarN("##value", ImGuiDataType_Float, values, count, speed, &min, &max, k_number, flags);
}

static bool draw_colour(const ParameterInfo& info, glm::vec3& colour) {
    bool changed = ImGui::ColorEdit3("##value", &colour.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    if (changed) colour = glm::clamp(colour, glm::vec3(float(info.min)), glm::vec3(float(info.max)));
    return changed;
}

static bool draw_integer(const ParameterInfo& info, int& value) {
    int min = int(std::max(info.min, -2147483648.0)), max = int(std::min(info.max, 2147483647.0));
    if (has_range(info) && info.max - info.min <= 4096) {
        return ImGui::SliderInt("##value", &value, min, max, "%d", ImGuiSliderFlags_AlwaysClamp);
    }
    return ImGui::DragInt("##value", &value, std::max(0.2f, std::abs(float(value)) * 0.01f), min, max, "%d",
                          ImGuiSliderFlags_AlwaysClamp);
}

/// A dropdown of an enumeration's names, or of all the numbers that a parameter may be.
static bool draw_choice(const std::string& name, const ParameterInfo& info, ParameterValue& value) {
    const std::string shown = to_text(info, value);
    if (!ImGui::BeginCombo("##value", shown.c_str())) return false;
    std::string chosen = shown;
    for (const std::string& choice : info.choices) {
        if (ImGui::Selectable(choice.c_str(), choice == shown)) chosen = choice;
        note_widget(name + "." + choice);
    }
    ImGui::EndCombo();
    if (chosen == shown) return false;
    value = parse_value(info, std::string_view(chosen));
    return true;
}

bool draw_parameter_widget(const std::string& name, const ParameterInfo& info, ParameterValue& value, bool& at_once) {
    at_once = info.kind == ParameterKind::boolean || !info.choices.empty();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (!info.choices.empty()) return draw_choice(name, info, value);
    switch (info.kind) {
    case ParameterKind::boolean:
        return ImGui::Checkbox("##value", &std::get<bool>(value));
    case ParameterKind::integer:
        return draw_integer(info, std::get<int>(value));
    case ParameterKind::enumeration:
        return draw_choice(name, info, value);
    case ParameterKind::real:
        return draw_reals(info, &std::get<float>(value), 1);
    case ParameterKind::vec2:
        return draw_reals(info, &std::get<glm::vec2>(value).x, 2);
    case ParameterKind::vec3:
        return draw_reals(info, &std::get<glm::vec3>(value).x, 3);
    case ParameterKind::vec4:
        return draw_reals(info, &std::get<glm::vec4>(value).x, 4);
    case ParameterKind::colour:
        return draw_colour(info, std::get<glm::vec3>(value));
    }
    return false;
}

} // namespace bounce
