#pragma once
// A point of a chart that comes from a file: what is not as the program writes it is refused before any of it reaches a
// file name or a page.

#include "app/experiments/chart_point.h"

namespace bounce {

/// Throws Error that begins with `where` unless the key is one (16 to 64 hexadecimal digits), sizes and counts are in
/// range, costs are no NaN, and pictures are PNGs in base64 or empty.
void check_point(const ChartPoint& point, const std::string& where);

} // namespace bounce
