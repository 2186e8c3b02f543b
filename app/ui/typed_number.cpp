#include "app/ui/typed_number.h"

#include <imgui_internal.h>

namespace bounce {

bool is_typing() {
    return ImGui::IsItemActive() && GImGui->ActiveId != 0 && GImGui->ActiveId == GImGui->InputTextState.ID;
}

bool typing_was_cancelled() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

} // namespace bounce
