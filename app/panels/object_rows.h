#pragma once
// The placed objects of the scene panel.

#include "app/panels/panel.h"

namespace bounce {

void draw_object_rows(PanelContext& context);

} // namespace bounce
