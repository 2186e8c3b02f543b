#pragma once
// What every part of the window draws from: data that it does not own.

#include "app/session.h"
#include "app/ui/ui_state.h"
#include "app/ui/undo.h"

namespace bounce {

struct PanelContext {
    Session& session;
    UiState& ui;
    UndoStack& undo;
};

} // namespace bounce
