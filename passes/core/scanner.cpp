#include "core/scanner.h"

#include <algorithm>

namespace bounce {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_word_character(char c) {
    return is_letter(c) || is_digit(c) || c == '_';
}

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

Scanner& Scanner::space() {
    while (!at_end() && is_space(text_[at_]))
        ++at_;
    return *this;
}

bool Scanner::take(char c) {
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    return true;
}

bool Scanner::take(std::string_view literal) {
    if (!rest().starts_with(literal)) return false;
    at_ += literal.size();
    return true;
}

bool Scanner::take_word(std::string_view wanted) {
    std::string_view after = rest();
    if (!after.starts_with(wanted)) return false;
    if (after.size() > wanted.size() && is_word_character(after[wanted.size()])) return false;
    at_ += wanted.size();
    return true;
}

std::string_view Scanner::word() {
    size_t start = at_;
    while (!at_end() && is_word_character(text_[at_]))
        ++at_;
    return text_.substr(start, at_ - start);
}

std::optional<int> Scanner::number(int max_digits) {
    int value = 0, digits = 0;
    while (digits < max_digits && is_digit(peek())) {
        value = 10 * value + (text_[at_++] - '0');
        ++digits;
    }
    if (digits == 0 || is_digit(peek())) return std::nullopt;
    return value;
}

std::optional<std::string_view> Scanner::until(char end) {
    size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) return std::nullopt;
    std::string_view before = text_.substr(at_, found - at_);
    at_ = found + 1;
    return before;
}

std::optional<std::pair<int, int>> scan_size(std::string_view text, int min_digits, int max_digits) {
    Scanner scanner(text);
    auto width = scanner.number(max_digits);
    size_t first = scanner.position();
    if (!width || !scanner.take('x')) return std::nullopt;
    auto height = scanner.number(max_digits);
    size_t second = scanner.position() - first - 1;
    if (!height || !scanner.at_end() || std::min(first, second) < size_t(min_digits)) return std::nullopt;
    return std::pair(*width, *height);
}

bool is_lower_case_name(std::string_view text, bool underscores) {
    if (text.empty() || text.size() > k_max_name || text[0] < 'a' || text[0] > 'z') return false;
    return std::all_of(text.begin(), text.end(),
                       [&](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || (underscores && c == '_'); });
}

std::string shortened(std::string_view text) {
    constexpr size_t k_shown = 60;
    if (text.size() <= k_shown) return std::string(text);
    size_t end = k_shown;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end; // not within a character of several bytes
    return std::string(text.substr(0, end)) + "…";
}

} // namespace bounce
