#pragma once
// The lights of the scene panel.

#include "app/panels/panel.h"

namespace bounce {

void draw_light_rows(PanelContext& context);

} // namespace bounce
