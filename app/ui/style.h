#pragma once
// How the window looks: neutral greys, so that they do not tint how a picture is judged; one accent colour.

#include <imgui.h>

namespace bounce {

/// Sizes and colours for interface units of `scale` screen coordinates.
void apply_style(float scale);
/// Loads the text font and the one of fixed width: from the program's folder (fonts/), else from the system, else
/// ImGui's own. The font texture must be made again afterwards. `pixel_ratio`: pixels per screen coordinate.
void load_fonts(float scale, float pixel_ratio);

ImFont* fixed_font();
float interface_scale(); ///< of the last apply_style

inline const ImVec4 k_error_colour{1.00f, 0.42f, 0.38f, 1};
inline const ImVec4 k_warning_colour{0.98f, 0.76f, 0.35f, 1};
inline const ImVec4 k_good_colour{0.50f, 0.82f, 0.50f, 1};
inline const ImVec4 k_dim_colour{0.60f, 0.60f, 0.62f, 1};
inline const ImVec4 k_accent_colour{0.36f, 0.62f, 0.92f, 1};

/// A tooltip of the last item.
void help(const char* text);
/// "name   value" on one line, the value at a fixed column.
void fact(const char* name, const char* format, ...) IM_FMTARGS(2);

} // namespace bounce
