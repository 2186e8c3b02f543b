#include "core/printable.h"

#include <algorithm>

namespace bounce {

/// The bytes of the UTF-8 character at `at`; 0 where there is none (overlong forms, surrogates and what lies beyond
/// U+10FFFF included).
static size_t character_bytes(std::string_view text, size_t at) {
    auto byte = [&](size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
    auto follows = [&](size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4 || !follows(1)) return 0;
    if (first < 0xe0) return 2;
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f)) return 0;
    if (first < 0xf0) return follows(2) ? 3 : 0;
    if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f)) return 0;
    return follows(2) && follows(3) ? 4 : 0;
}

std::string markdown_cell(std::string_view text) {
    std::string out;
    for (char c : printable(text)) {
        if (c == '|')
            out += "\\|";
        else if (c == '<')
            out += "&lt;";
        else
            out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (size_t at = 0; at < text.size();) {
        const size_t bytes = character_bytes(text, at);
        const auto first = static_cast<unsigned char>(text[at]);
        const bool control = (bytes == 1 && (first < 0x20 || first == 0x7f) && first != '\n' && first != '\t') ||
                             (bytes == 2 && first == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0);
        if (bytes == 0 || control)
            out += "\uFFFD";
        else
            out += text.substr(at, bytes);
        at += std::max<size_t>(bytes, 1);
    }
    return out;
}

} // namespace bounce
