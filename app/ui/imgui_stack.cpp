#include "app/ui/imgui_stack.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace bounce {

ImGuiStack::ImGuiStack() : windows_(ImGui::GetCurrentContext()->CurrentWindowStack.Size) {}

void ImGuiStack::unwind() const {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    while (true) {
        ImGui::ErrorCheckEndWindowRecover(nullptr);
        if (context.CurrentWindowStack.Size <= windows_) return;
        if (context.CurrentWindow->Flags & ImGuiWindowFlags_ChildWindow)
            ImGui::EndChild();
        else
            ImGui::End();
    }
}

} // namespace bounce
