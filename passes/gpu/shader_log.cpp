// What drivers say of shaders, told in terms of the files that they come from.
#include "core/scanner.h"
#include "core/text.h"
#include "gpu/shader_location.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

/// The line of the flat text that a line of a log tells of, and what it says: Mesa "0:12(5): error: …", NVIDIA
/// "0(12) : error …", AMD, Intel and glslang "ERROR: 0:12: …". 0 when it tells of none.
static size_t numbered_line(std::string_view text, std::string_view& message) {
    constexpr int k_digits = 9;
    Scanner scanner(text);
    bool headed = scanner.space().take("ERROR:");
    if (!scanner.space().number(k_digits)) return 0;
    bool bracket = !headed && scanner.take('(');
    if (!bracket && !scanner.take(':')) return 0;
    std::optional<int> line = scanner.number(k_digits);
    bool good = line.has_value();
    if (bracket)
        good = good && scanner.take(')') && scanner.space().take(':');
    else if (headed)
        good = good && scanner.take(':');
    else // a column in brackets
        good = good && scanner.take('(') && scanner.number(k_digits) && scanner.take("):");
    if (!good) return 0;
    message = trim(scanner.rest());
    return size_t(*line);
}

std::vector<ShaderError> translate_log(const std::string& log, const ShaderSource& source, const fs::path& folder) {
    std::vector<ShaderError> errors;
    for (const std::string& line : split(log, '\n')) {
        if (trim(line).empty() || trim(line).starts_with("WARNING:")) continue;
        std::string_view message = line;
        size_t number = numbered_line(line, message);
        ShaderError error = located_error(source, folder, number, std::string(message));
        if (error.message.find("warning") == 0) continue;
        errors.push_back(error);
    }
    return errors;
}

/// "Fragment info".
static bool is_heading(std::string_view line) {
    Scanner scanner(line);
    return !scanner.space().word().empty() && scanner.take(' ') && scanner.take_word("info") &&
           scanner.space().at_end();
}

static bool is_underline(std::string_view line) {
    line = trim(line);
    return !line.empty() && line.find_first_not_of('-') == std::string_view::npos;
}

/// The stage that a driver's sentence names first ("fragment shader input `x' …"); null when it names none.
static const ShaderSource* stage_named(const std::string& line, const std::vector<ShaderSource>& stages) {
    const ShaderSource* found = nullptr;
    size_t first = std::string::npos;
    const std::pair<const char*, ShaderStage> names[] = {{"vertex", ShaderStage::vertex},
                                                         {"geometry", ShaderStage::geometry},
                                                         {"fragment", ShaderStage::fragment},
                                                         {"compute", ShaderStage::compute}};
    std::string lower = line;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    for (const auto& [name, stage] : names) {
        size_t at = lower.find(name);
        if (at >= first) continue;
        for (const ShaderSource& source : stages) {
            if (stage_of(source.files.front()) == stage) found = &source, first = at;
        }
    }
    return found;
}

std::vector<ShaderError> translate_link_log(const std::string& log, const std::vector<ShaderSource>& stages,
                                            const fs::path& folder) {
    // NVIDIA heads what belongs to a stage ("Fragment info", underlined); others name it in the sentence.
    const ShaderSource* headed = nullptr;
    std::vector<ShaderError> errors;
    for (const std::string& line : split(log, '\n')) {
        if (is_heading(line)) headed = stage_named(line, stages);
        if (is_heading(line) || is_underline(line)) continue;
        const ShaderSource* stage = headed ? headed : stage_named(line, stages);
        for (ShaderError& error : translate_log(line, stage ? *stage : stages.front(), folder)) {
            if (!stage && stages.size() > 1) error.file = shown(stages.front().files.front(), folder), error.line = 0;
            if (error.line == 0) error.source_line.clear();
            error.message = fmt::format("does not link: {}", trim(error.message));
            errors.push_back(error);
        }
    }
    if (errors.empty())
        errors.push_back(
            {shown(stages.front().files.front(), folder), 0, "", "does not link (the driver does not say why)"});
    return errors;
}

} // namespace bounce
