#pragma once

#include <string>
#include <string_view>

namespace bounce {

/// Text from outside as it may be shown: what is no UTF-8, and control characters (which a terminal carries out and a
/// page's parser refuses) other than line ends and tabs, become U+FFFD.
std::string printable(std::string_view text);

/// The same for a cell of a Markdown table: no end of the cell or line, and no HTML.
std::string markdown_cell(std::string_view text);

} // namespace bounce
