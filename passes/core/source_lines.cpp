#include "core/source_lines.h"

#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>
#include <utility>

namespace bounce {

size_t end_of_comment(std::string_view text, size_t at) {
    std::string_view rest = text.substr(at);
    if (rest.starts_with("//")) return std::min(text.find('\n', at), text.size());
    if (!rest.starts_with("/*")) return at;
    size_t end = text.find("*/", at + 2);
    return end == std::string_view::npos ? end : end + 2;
}

size_t end_of_string(std::string_view text, size_t at) {
    for (size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == '"') return i + 1;
        if (text[i] == '\\') ++i;
    }
    return std::string_view::npos;
}

std::vector<std::string> split_lines(std::string_view text, std::optional<std::string>& why_not) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        why_not = "the file is UTF-16: expected UTF-8 text";
        return {};
    }
    if (text.find('\0') != std::string_view::npos) {
        why_not = "the file holds a zero byte: expected UTF-8 text";
        return {};
    }
    std::vector<std::string> lines;
    size_t start = 0;
    while (start < text.size()) {
        size_t end = std::min(text.find_first_of("\r\n", start), text.size());
        lines.emplace_back(text.substr(start, end - start));
        start = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    }
    return lines;
}

/// The next line with those that continue it, joined.
std::string CodeLines::join_written(CodeLine& line) {
    std::string joined;
    while (at_ < lines_.size()) {
        std::string& part = lines_[at_++];
        bool goes_on = part.ends_with('\\');
        if (goes_on && at_ == lines_.size()) part.pop_back(); // it would take in what the file is included into
        joined.append(part, 0, part.size() - (goes_on && at_ < lines_.size() ? 1 : 0));
        line.written.push_back(part);
        if (!goes_on) break;
    }
    return joined;
}

/// Whether what comes next is the file name of an include: its slashes begin no comment.
static bool names_a_file(std::string_view code) {
    Scanner scanner(code);
    return scanner.space().take('#') && scanner.space().take_word("include") && scanner.space().at_end();
}

void CodeLines::strip_comments(const std::string& joined, CodeLine& line) {
    int last = line.number + int(line.written.size()) - 1;
    bool may_name_a_file = true, any_code = line.directive || !trim(line.code).empty();
    size_t i = 0;
    if (open_) {
        size_t end = joined.find("*/");
        if (end == std::string::npos) return;
        open_ = 0;
        if (line.code.empty()) line.code += ' '; // else the comment began in it
        i = end + 2;
    }
    while (i < joined.size()) {
        char c = joined[i];
        std::string_view rest = std::string_view(joined).substr(i);
        if (rest.starts_with("//")) {
            if (rest.starts_with("//!")) line.mark = std::string(trim(rest.substr(3)));
            return;
        }
        if (rest.starts_with("/*")) {
            code_before_comment_ = (line.in_comment && code_before_comment_) || any_code;
            size_t end = end_of_comment(joined, i);
            line.code += ' ';
            if (end == std::string::npos) {
                open_ = last;
                return;
            }
            i = end;
            continue;
        }
        if ((c == '"' || c == '<') && std::exchange(may_name_a_file, false) && names_a_file(line.code)) {
            size_t end = joined.find(c == '"' ? '"' : '>', i + 1);
            if (end != std::string::npos) {
                line.code.append(joined, i, end + 1 - i);
                i = end + 1;
                continue;
            }
        }
        line.code += c;
        any_code = any_code || !is_space(c);
        ++i;
    }
}

std::optional<CodeLine> CodeLines::next() {
    if (at_ == lines_.size()) return std::nullopt;
    CodeLine line;
    line.number = int(at_) + 1;
    line.in_comment = open_ > 0;
    bool first_of_line = !line.in_comment || !code_before_comment_;
    strip_comments(join_written(line), line);
    line.directive = first_of_line && trim(line.code).starts_with("#");
    while (line.directive && open_ && at_ < lines_.size())
        strip_comments(join_written(line), line);
    return line;
}

} // namespace bounce
