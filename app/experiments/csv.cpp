#include "app/experiments/csv.h"

#include "core/printable.h"

#include <cstdlib>
#include <cstring>

namespace bounce {

static bool is_number(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0';
}

std::string csv_field(const std::string& raw) {
    std::string text = printable(raw);
    if (!text.empty() && std::strchr("=+-@\t", text[0]) && !is_number(text)) text.insert(0, "'");
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

} // namespace bounce
