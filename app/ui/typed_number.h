#pragma once
// Numbers that are typed take effect when a person is done (Enter, or a click elsewhere) and not at each digit, and
// Escape takes them back. What is dragged is followed at once.

#include <imgui.h>
#include <optional>

namespace bounce {

/// Whether text is being typed into the item that was drawn last.
bool is_typing();
/// Whether a text was left by Escape in this frame.
bool typing_was_cancelled();

/// Draws a widget of `value` by `draw(value)`, which tells whether a person changed it. Returns true, with the new
/// value, when that is to take effect. `label`: names the widget in its panel.
template <typename T, typename Draw>
bool edit_number(const char* label, T& value, Draw draw) {
    struct Held {
        ImGuiID id;
        T value;
    };
    static std::optional<Held> held; // what is being typed, of all widgets of this type
    const ImGuiID id = ImGui::GetID(label);
    const bool was_held = held && held->id == id;
    T shown = was_held ? held->value : value;
    bool changed = draw(shown);
    if (is_typing()) {
        if (changed || was_held) held = Held{id, shown};
        return false;
    }
    if (was_held) {
        held.reset();
        if (typing_was_cancelled()) return false;
        changed = shown != value;
    }
    if (changed) value = shown;
    return changed;
}

} // namespace bounce
