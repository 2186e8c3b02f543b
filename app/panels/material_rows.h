#pragma once
// The materials of the scene panel.

#include "app/panels/panel.h"

namespace bounce {

void draw_material_rows(PanelContext& context);

} // namespace bounce
