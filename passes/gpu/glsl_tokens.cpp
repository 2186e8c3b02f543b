#include "gpu/glsl_tokens.h"

#include "core/scanner.h"

#include <algorithm>

namespace bounce {

bool GlslToken::is_word() const {
    return !text.empty() && (is_letter(text[0]) || text[0] == '_');
}

bool GlslToken::is_number() const {
    return !text.empty() && (is_digit(text[0]) || (text.size() > 1 && text[0] == '.' && is_digit(text[1])));
}

/// "12u", "1.5e-3": a digit and all that may follow one.
static size_t number_length(std::string_view code) {
    size_t end = 1;
    while (end < code.size()) {
        char c = code[end];
        bool sign = (c == '+' || c == '-') && (code[end - 1] == 'e' || code[end - 1] == 'E') && !code.starts_with("0x");
        if (!is_word_character(c) && c != '.' && !sign) break;
        ++end;
    }
    return end;
}

static size_t operator_length(std::string_view code) {
    static const std::string_view operators[] = {"<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
                                                 "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "##"};
    for (std::string_view known : operators)
        if (code.starts_with(known)) return known.size();
    return 1;
}

std::vector<GlslToken> tokens_of(std::string_view code, int line) {
    std::vector<GlslToken> tokens;
    Scanner scanner(code);
    while (!scanner.space().at_end()) {
        std::string_view rest = scanner.rest();
        size_t length = 1;
        if (is_digit(rest[0]) || (rest[0] == '.' && rest.size() > 1 && is_digit(rest[1])))
            length = number_length(rest);
        else if (is_word_character(rest[0]))
            length = Scanner(rest).word().size();
        else
            length = operator_length(rest);
        tokens.push_back({rest.substr(0, length), line});
        scanner.take(rest.substr(0, length));
    }
    return tokens;
}

} // namespace bounce
