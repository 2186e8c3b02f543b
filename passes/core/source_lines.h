#pragma once
// Lines of code as a compiler takes them: lines that end in a backslash are joined, comments are blanked, and what
// stands in strings is no comment. Shader text and JSON text with comments are both read with it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

/// Behind the comment that begins at `at` ("//" or "/*"): at the line's end, or behind "*/". npos when a block comment
/// does not end; `at` itself when no comment begins there.
size_t end_of_comment(std::string_view text, size_t at);
/// Behind the string that begins at `at` with a quotation mark, in which a backslash hides the character after it. npos
/// when it does not end.
size_t end_of_string(std::string_view text, size_t at);

/// A file's text as lines without their ends: \n, \r\n or \r. A byte order mark of UTF-8 is left out. `why_not` becomes
/// a reason when the bytes are no such text (a zero byte, UTF-16), and is left alone else.
std::vector<std::string> split_lines(std::string_view text, std::optional<std::string>& why_not);

/// One line of code, which may be written over several.
struct CodeLine {
    std::vector<std::string> written; ///< as in the file
    int number = 0;                   ///< of the first, 1-based
    std::string code;                 ///< joined; each comment is one blank
    std::optional<std::string> mark;  ///< what follows "//!", trimmed, when the line ends in such a comment
    bool in_comment = false;          ///< a comment that began before is still open where the line begins
    bool directive = false;           ///< its first character is a '#'
};

class CodeLines {
  public:
    explicit CodeLines(std::vector<std::string> lines) : lines_(std::move(lines)) {}
    /// The next line; nullopt at the end. A directive goes on to the end of a comment that begins in it.
    std::optional<CodeLine> next();
    /// Where the comment that is open begins; 0 when none is.
    int open_comment() const { return open_; }

  private:
    std::string join_written(CodeLine& line);
    void strip_comments(const std::string& joined, CodeLine& line);

    std::vector<std::string> lines_;
    size_t at_ = 0;
    int open_ = 0;
    bool code_before_comment_ = false; ///< on the line where the open comment began: what ends it begins no directive
};

} // namespace bounce
