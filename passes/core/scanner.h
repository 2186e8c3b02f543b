#pragma once
// Reads text piece by piece, from left to right and never back: its time is linear in the text, and it needs no stack,
// however long or odd the text is. Shader text, names and sizes are read with it.

#include <optional>
#include <string>
#include <string_view>

namespace bounce {

/// Of GLSL words and of all names here: ASCII letters, digits, underscores.
bool is_letter(char c);
bool is_digit(char c);
bool is_word_character(char c);
/// Blank, tab, carriage return, line feed, vertical tab, form feed.
bool is_space(char c);

class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    bool at_end() const { return at_ == text_.size(); }
    /// The next character; '\0' at the end.
    char peek() const { return at_end() ? '\0' : text_[at_]; }
    size_t position() const { return at_; }
    std::string_view rest() const { return text_.substr(at_); }

    /// Skips white space. Returns itself, so that `scanner.space().take('=')` reads on.
    Scanner& space();
    bool take(char c);
    bool take(std::string_view literal);
    /// As `take`, but the literal must be a whole word.
    bool take_word(std::string_view word);
    /// The longest run of word characters; empty when there is none.
    std::string_view word();
    /// 1 to `max_digits` decimal digits with no further digit behind them.
    std::optional<int> number(int max_digits);
    /// Everything before the first `end`, which is taken, too; nothing is read when there is none.
    std::optional<std::string_view> until(char end);

  private:
    std::string_view text_;
    size_t at_ = 0;
};

/// "1280x720", each side of `min_digits` to `max_digits` digits: width and height.
std::optional<std::pair<int, int>> scan_size(std::string_view text, int min_digits, int max_digits);

/// Names of passes, resources and files are at most this long.
constexpr size_t k_max_name = 100;
/// Whether `text` is 1 to k_max_name characters, the first a lower case letter, the others lower case letters, digits
/// and, if `underscores`, underscores.
bool is_lower_case_name(std::string_view text, bool underscores);

/// The text, cut after some 60 bytes at a character's end where it is longer: for messages that quote it.
std::string shortened(std::string_view text);

} // namespace bounce
