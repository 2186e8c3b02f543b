#pragma once
// Fields of CSV files.

#include <string>

namespace bounce {

/// RFC 4180. A spreadsheet takes a text that begins with one of = + - @ for a formula and runs it: an apostrophe before
/// it keeps it a text.
std::string csv_field(const std::string& text);

} // namespace bounce
