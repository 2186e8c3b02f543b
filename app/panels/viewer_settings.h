#pragma once
// The controls of how a texture is shown, and the table of a buffer's words: the lower part of the resources panel.

#include "app/panels/panel.h"

namespace bounce {

/// Mip, layer, channel, range … of ui.viewer, which is meant for `resource`.
void draw_viewer_settings(PanelContext& context, const PlanResource& resource);

/// One page of a buffer, a row an element (or a part of one that is long), read back now.
void draw_buffer_table(PanelContext& context, const PlanResource& resource);

/// A word of a buffer as text; `words` as BufferSettings::words.
std::string word_text(uint32_t word, int words);

} // namespace bounce
