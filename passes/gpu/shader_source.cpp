#include "gpu/shader_source.h"

#include "core/error.h"
#include "core/image.h"
#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <optional>
#include <regex>
#include <set>

namespace bounce {

namespace fs = std::filesystem;

ShaderStage stage_of(const fs::path& file) {
    std::string extension = file.extension().string();
    if (extension == ".vert") return ShaderStage::vertex;
    if (extension == ".geom") return ShaderStage::geometry;
    if (extension == ".frag") return ShaderStage::fragment;
    if (extension == ".comp") return ShaderStage::compute;
    throw Error("'" + file.string() + "' is no shader stage: its extension is .vert, .geom, .frag or .comp");
}

std::string ShaderError::text() const {
    std::string out = file.string();
    if (line) out += fmt::format(":{}", line);
    out += ": " + message;
    if (!source_line.empty()) out += "\n    " + source_line;
    return out;
}

std::string slot_name(const std::string& identifier) {
    std::string name = identifier;
    if (size_t underscore = name.find('_'); underscore != std::string::npos) name[underscore] = '.';
    return name;
}

std::string slot_identifier(const std::string& name) {
    std::string identifier = name;
    if (size_t dot = identifier.find('.'); dot != std::string::npos) identifier[dot] = '_';
    return identifier;
}

namespace {

fs::path shown(const fs::path& file, const fs::path& folder) {
    fs::path relative = file.lexically_relative(folder);
    return relative.empty() || *relative.begin() == ".." ? file : relative;
}

/// Everything that is being gathered while one stage is expanded.
class Expander {
  public:
    Expander(const fs::path& folder, const Defines& defines, const Defines& statics)
        : folder_(folder), defines_(defines), statics_(statics) {}

    ShaderSource run(const fs::path& file) {
        include(file, {});
        std::vector<std::string> head = {"#version 460 core"};
        head.insert(head.end(), extensions_.begin(), extensions_.end());
        for (const auto& [name, value] : defines_)
            head.push_back("#define " + name + " " + value);
        std::vector<SourceLocation> lines(head.size());
        lines.insert(lines.end(), out_.lines.begin(), out_.lines.end());
        out_.lines = std::move(lines);
        out_.text = join(head, "\n") + "\n" + body_;
        return std::move(out_);
    }

  private:
    void error(const fs::path& file, int line, const std::string& source_line, const std::string& message) {
        out_.errors.push_back({shown(file, folder_), line, std::string(trim(source_line)), message});
    }

    void include(const fs::path& file, const ShaderError& from) {
        fs::path normal = file.lexically_normal();
        if (std::find(out_.files.begin(), out_.files.end(), normal) != out_.files.end()) return;
        std::string text;
        try {
            text = read_file(normal);
        } catch (const Error& failure) {
            out_.missing.push_back(normal);
            if (out_.files.empty()) out_.files.push_back(normal);
            if (from.line)
                error(folder_ / from.file, from.line, from.source_line, failure.what());
            else
                error(normal, 0, "", failure.what());
            return;
        }
        int index = int(out_.files.size());
        out_.files.push_back(normal);
        int number = 0;
        size_t start = 0;
        while (start < text.size()) {
            size_t end = std::min(text.find('\n', start), text.size());
            std::string line = text.substr(start, end - start);
            if (!line.empty() && line.back() == '\r') line.pop_back();
            take_line(line, index, ++number);
            start = end + 1;
        }
    }

    void emit(const std::string& line, int file, int number) {
        body_ += line;
        body_ += '\n';
        out_.lines.push_back({file, number});
    }

    void take_line(const std::string& line, int file, int number) {
        std::string_view bare = trim(line);
        if (in_comment_) {
            in_comment_ = bare.find("*/") == std::string_view::npos;
            emit(line, file, number);
            return;
        }
        if (bare.starts_with("/*") && bare.find("*/") == std::string_view::npos) {
            in_comment_ = true;
            emit(line, file, number);
            return;
        }
        if (bare.starts_with("#"))
            take_directive(std::string(trim(bare.substr(1))), line, file, number);
        else if (!bare.starts_with("//"))
            take_code(line, file, number);
        else
            emit(line, file, number);
    }

    void take_directive(const std::string& directive, const std::string& line, int file, int number) {
        if (directive.starts_with("include")) {
            static const std::regex form(R"(include\s*["<]([^">]+)[">].*)");
            std::smatch match;
            if (!std::regex_match(directive, match, form)) {
                error(out_.files[file], number, line, "an include is written #include \"file\"");
                return;
            }
            if (!active()) {
                emit("//", file, number); // once a stage: it must not use up the file's one turn
                return;
            }
            fs::path beside = out_.files[file].parent_path() / match[1].str();
            fs::path target = fs::exists(beside) ? beside : folder_ / match[1].str();
            include(target, {shown(out_.files[file], folder_), number, line, ""});
        } else if (directive.starts_with("version")) {
            emit("// " + line, file, number); // ours stands at the top
        } else if (directive.starts_with("extension")) {
            extensions_.push_back("#" + directive); // must come before other code
            emit("//", file, number);
        } else if (directive.starts_with("line")) {
            emit("//", file, number); // would spoil the line table
        } else {
            std::string told = with_static_value(directive);
            follow_condition(told);
            emit(told == directive ? line : "#" + told, file, number);
        }
    }

    /// "#if name" and "#if !name" over a //! static bool become #if 1 or #if 0: what is behind them is known, too.
    std::string with_static_value(const std::string& directive) const {
        static const std::regex form(R"(if\s+(!?)\s*(\w+)\s*(//.*)?)");
        std::smatch match;
        if (!std::regex_match(directive, match, form)) return directive;
        auto value = static_bools_.find(match[2]);
        if (value == static_bools_.end()) return directive;
        return value->second != (match[1] == "!") ? "if 1" : "if 0";
    }

    /// Follows #if 0, #if 1 (and so #if over a //! static bool), #ifdef and #ifndef over the names that the text itself
    /// defines, so that slots and parameters behind them are known to be there or not. Other conditions (#if) are left
    /// open: their branches all count.
    void follow_condition(const std::string& directive) {
        static const std::regex define(R"(define\s+(\w+).*)"), undef(R"(undef\s+(\w+).*)");
        static const std::regex ifdef(R"(ifdef\s+(\w+).*)"), ifndef(R"(ifndef\s+(\w+).*)");
        static const std::regex constant(R"(if\s+([01])\s*(//.*)?)");
        std::smatch match;
        auto defined = [&](const std::string& name) { return defines_.contains(name) || seen_.contains(name); };
        if (std::regex_match(directive, match, define)) {
            if (active()) seen_.insert(match[1]);
        } else if (std::regex_match(directive, match, undef)) {
            if (active()) seen_.erase(match[1]);
        } else if (std::regex_match(directive, match, ifdef)) {
            conditions_.push_back(defined(match[1]));
        } else if (std::regex_match(directive, match, ifndef)) {
            conditions_.push_back(!defined(match[1]));
        } else if (std::regex_match(directive, match, constant)) {
            conditions_.push_back(match[1] != "0");
        } else if (directive.starts_with("if")) {
            conditions_.push_back(std::nullopt);
        } else if (directive.starts_with("else") && !conditions_.empty()) {
            if (conditions_.back()) conditions_.back() = !*conditions_.back();
        } else if (directive.starts_with("elif") && !conditions_.empty()) {
            conditions_.back() = std::nullopt;
        } else if (directive.starts_with("endif") && !conditions_.empty()) {
            conditions_.pop_back();
        }
    }

    bool active() const {
        return std::none_of(conditions_.begin(), conditions_.end(), [](auto& c) { return c.has_value() && !*c; });
    }

    void take_code(const std::string& line, int file, int number) {
        if (!active()) {
            emit(line, file, number);
            return;
        }
        std::string where = fmt::format("{}:{}", shown(out_.files[file], folder_).string(), number);
        ParameterInfo info;
        bool is_parameter = false;
        try {
            is_parameter = parse_parameter_line(line, info);
        } catch (const Error& failure) {
            error(out_.files[file], number, line, failure.what());
        }
        if (is_parameter) {
            info.where = where;
            if (info.is_static) {
                auto value = statics_.find(info.name);
                std::string text = value != statics_.end() ? value->second : glsl_literal(info);
                emit(fmt::format("#define {} {}", info.name, text), file, number);
                if (text == "true" || text == "false") static_bools_[info.name] = text == "true";
            } else {
                emit(line, file, number);
            }
            auto same = std::find_if(out_.parameters.begin(), out_.parameters.end(),
                                     [&](const ParameterInfo& p) { return p.name == info.name; });
            if (same == out_.parameters.end()) out_.parameters.push_back(info);
            return;
        }
        take_slot(line, where, out_.files[file], number);
        emit(line, file, number);
    }

    static std::string glsl_literal(const ParameterInfo& info);

    void take_slot(const std::string& line, const std::string& where, const fs::path& file, int number) {
        static const std::regex opaque(R"(\buniform\b.*?\b([iu]?(sampler|image)\w+)\s+(\w+)\s*(\[\s*\w+\s*\])?\s*;)");
        static const std::regex block(R"(\bbuffer\s+(?:\w+\s+)*?(\w+)\s*(\{|$|//))");
        std::smatch match;
        std::string code = line.substr(0, line.find("//"));
        ShaderSlot slot;
        if (std::regex_search(code, match, opaque)) {
            slot.type = match[1];
            slot.kind = match[2] == "sampler" ? SlotKind::sampled : SlotKind::image;
            slot.identifier = match[3];
        } else if (code.find("buffer") != std::string::npos && std::regex_search(code, match, block)) {
            slot.kind = SlotKind::storage;
            slot.identifier = match[1];
        } else {
            return;
        }
        auto has = [&](const char* word) { return std::regex_search(code, std::regex(fmt::format("\\b{}\\b", word))); };
        slot.name = slot_name(slot.identifier);
        slot.writes = slot.kind != SlotKind::sampled && !has("readonly");
        slot.reads = !has("writeonly");
        slot.where = where;
        slot.certain = std::all_of(conditions_.begin(), conditions_.end(), [](auto& c) { return c.has_value(); });
        if (size_t mark = line.find("//!"); mark != std::string::npos) {
            slot.optional = trim(std::string_view(line).substr(mark + 3)).starts_with("optional");
        }
        if (slot.name.find('.') == std::string::npos) {
            error(file, number, line,
                  fmt::format("'{0}' is no name for a resource: write it with an underscore, as group_{0}, for the "
                              "resource group.{0}",
                              slot.identifier));
            return;
        }
        auto same = std::find_if(out_.slots.begin(), out_.slots.end(),
                                 [&](const ShaderSlot& s) { return s.identifier == slot.identifier; });
        if (same == out_.slots.end()) out_.slots.push_back(slot);
    }

    std::map<std::string, bool> static_bools_;
    fs::path folder_;
    const Defines& defines_;
    const Defines& statics_;
    ShaderSource out_;
    std::string body_;
    std::vector<std::string> extensions_;
    std::set<std::string> seen_;                  ///< names that #define lines so far have defined
    std::vector<std::optional<bool>> conditions_; ///< of the #if blocks around the present line; empty: unknown
    bool in_comment_ = false;
};

} // namespace

std::string static_literal(const ParameterInfo& info, const ParameterValue& value) {
    std::string text = to_text(info, value);
    switch (info.kind) {
    case ParameterKind::enumeration:
        return std::to_string(std::get<int>(value));
    case ParameterKind::real:
        return text.find_first_of(".e") == std::string::npos ? "(" + text + ".0)" : "(" + text + ")";
    case ParameterKind::vec2:
        return "vec2(" + text + ")";
    case ParameterKind::vec3:
    case ParameterKind::colour:
        return "vec3(" + text + ")";
    case ParameterKind::vec4:
        return "vec4(" + text + ")";
    default:
        return text;
    }
}

std::string Expander::glsl_literal(const ParameterInfo& info) {
    return static_literal(info, info.default_value);
}

ShaderSource expand_shader(const fs::path& file, const fs::path& folder, const Defines& defines,
                           const Defines& static_values) {
    return Expander(folder, defines, static_values).run(folder / file);
}

std::vector<ShaderError> translate_log(const std::string& log, const ShaderSource& source, const fs::path& folder) {
    static const std::regex forms[] = {
        std::regex(R"(^\s*\d+:(\d+)\(\d+\):\s*(.*)$)"),   // Mesa
        std::regex(R"(^\s*\d+\((\d+)\)\s*:\s*(.*)$)"),    // NVIDIA
        std::regex(R"(^\s*ERROR:\s*\d+:(\d+):\s*(.*)$)"), // AMD, Intel, glslang
    };
    std::vector<std::string> flat = split(source.text, '\n');
    std::vector<ShaderError> errors;
    for (const std::string& line : split(log, '\n')) {
        if (trim(line).empty() || trim(line).starts_with("WARNING:")) continue;
        std::smatch match;
        ShaderError error;
        error.message = line;
        if (!source.files.empty()) error.file = shown(source.files.front(), folder);
        for (const std::regex& form : forms) {
            if (!std::regex_match(line, match, form)) continue;
            size_t number = size_t(std::stoul(match[1]));
            error.message = match[2];
            if (number >= 1 && number <= source.lines.size() && source.lines[number - 1].line) {
                SourceLocation at = source.lines[number - 1];
                error.file = shown(source.files[at.file], folder);
                error.line = at.line;
                error.source_line = flat[number - 1];
            }
            break;
        }
        if (error.message.find("warning") == 0) continue;
        errors.push_back(error);
    }
    return errors;
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
    static const std::regex heading(R"(^\s*\w+ info\s*$)"), underline(R"(^\s*-+\s*$)");
    const ShaderSource* headed = nullptr;
    std::vector<ShaderError> errors;
    for (const std::string& line : split(log, '\n')) {
        if (std::regex_match(line, heading)) headed = stage_named(line, stages);
        if (std::regex_match(line, heading) || std::regex_match(line, underline)) continue;
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
