#pragma once
// The `uniform … //! …` lines of shaders, whose comments are told apart already (core/source_lines.h).

#include "core/parameters.h"

namespace bounce {

/// As parse_parameter_line(line, info): `code` is the line without comments, `mark` what follows "//!".
bool parse_parameter_line(std::string_view code, std::string_view mark, ParameterInfo& info);

} // namespace bounce
