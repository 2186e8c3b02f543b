#include "app/ui/edit.h"

namespace bounce {

static int presses = 0;

void begin_edit_frame() {
    // While a widget is held it stays the same press; the frame of a release still belongs to it.
    if (!ImGui::IsAnyItemActive()) ++presses;
}

int press_number() {
    return presses;
}

} // namespace bounce
