#pragma once
// The frame of every page that a command writes: one file, no network, no script.

#include <string>

namespace bounce {

/// `body` is markup; `title` and `style` are not. `style` comes after the shared one.
std::string html_page(const std::string& title, const std::string& style, const std::string& body);

} // namespace bounce
