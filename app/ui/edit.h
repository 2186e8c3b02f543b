#pragma once
// Edits of scene values that can be undone: from press to release of the mouse is one step.

#include "app/ui/panel_context.h"

#include <imgui.h>
#include <memory>

namespace bounce {

/// At the start of each drawn frame.
void begin_edit_frame();
/// Which press of the mouse (or stay in a text field) a change belongs to: changes of one press are one step.
int press_number();

/// A value changed from `before` to `after`, which is applied by `apply(value)` now and at each undo and redo. `apply`
/// must bear that the scene is another one (the stack is cleared then, but be safe).
template <typename T, typename Apply>
void edit(PanelContext& context, const std::string& what, const T& before, const T& after, Apply apply) {
    static std::string last_what;
    static int last_press = -1;
    static std::shared_ptr<T> last_after;
    apply(after);
    if (last_what == what && last_press == press_number() && last_after && context.undo.next_undo() == what) {
        *last_after = after; // the same drag goes on
        return;
    }
    last_what = what;
    last_press = press_number();
    last_after = std::make_shared<T>(after);
    context.undo.push({what, [apply, before] { apply(before); }, [apply, value = last_after] { apply(*value); }});
}

} // namespace bounce
