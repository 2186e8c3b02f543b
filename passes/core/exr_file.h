#pragma once
// OpenEXR files for other programs: beside our named layers, one that every viewer shows.

#include "core/image.h"

namespace bounce {

/// As write_exr in image.h; `default_layer` is stored under plain channel names (Y, R G, R G B, R G B A), and beside
/// other layers under its own name too. read_exr gives it its name back. Throws Error when there is no such layer.
void write_exr(const std::filesystem::path& path, const LayeredImage& image, const std::string& default_layer);

} // namespace bounce
