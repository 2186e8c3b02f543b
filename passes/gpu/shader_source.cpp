#include "gpu/shader_source.h"

#include "core/error.h"
#include "core/input_file.h"
#include "core/parameter_line.h"
#include "core/scanner.h"
#include "core/source_lines.h"
#include "core/text.h"
#include "gpu/shader_limits.h"
#include "gpu/shader_location.h"
#include "gpu/shader_paths.h"
#include "gpu/slot_note.h"
#include "gpu/slot_reader.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
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

fs::path shown(const fs::path& file, const fs::path& folder) {
    fs::path relative = file.lexically_relative(folder);
    return relative.empty() || *relative.begin() == ".." ? file : relative;
}

ShaderError located_error(const ShaderSource& source, const fs::path& folder, size_t flat_line,
                          const std::string& message) {
    ShaderError error;
    error.message = message;
    if (!source.files.empty()) error.file = shown(source.files.front(), folder);
    if (flat_line < 1 || flat_line > source.lines.size() || !source.lines[flat_line - 1].line) return error;
    SourceLocation at = source.lines[flat_line - 1];
    error.file = shown(source.files[size_t(at.file)], folder);
    error.line = at.line;
    size_t begin = 0;
    for (size_t line = 1; line < flat_line; ++line)
        begin = source.text.find('\n', begin) + 1;
    error.source_line =
        shortened(trim(std::string_view(source.text).substr(begin, source.text.find('\n', begin) - begin)));
    return error;
}

namespace {

constexpr int64_t k_max_errors = 50;

/// What is known of the #if blocks around a line.
struct Condition {
    std::optional<bool> holds; ///< the branch that the line is in; empty: only the compiler knows
    bool another_held = false; ///< a branch above it did, so that none below does
};

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
        head.insert(head.end(), choices_.begin(), choices_.end());
        std::vector<SourceLocation> lines(head.size());
        lines.insert(lines.end(), out_.lines.begin(), out_.lines.end());
        out_.lines = std::move(lines);
        out_.text = join(head, "\n") + "\n" + body_;
        return std::move(out_);
    }

  private:
    void error(const fs::path& file, int line, const std::string& source_line, const std::string& message) {
        out_.errors.push_back({shown(file, folder_), line, shortened(trim(source_line)), message});
    }

    std::string too_long() const {
        return fmt::format("the stage has more than {} bytes (text_bytes)", limits_.text_bytes);
    }

    void include(const fs::path& file, const ShaderError& from) {
        fs::path normal = file.lexically_normal();
        if (std::find(out_.files.begin(), out_.files.end(), normal) != out_.files.end()) return;
        auto refuse = [&](const std::string& why) {
            if (out_.files.empty()) out_.files.push_back(normal);
            if (from.line)
                error(folder_ / from.file, from.line, from.source_line, why);
            else
                error(normal, 0, "", why);
        };
        if (depth_ >= limits_.include_depth)
            return refuse(fmt::format("includes are nested more than {} deep (include_depth)", limits_.include_depth));
        if (int64_t(out_.files.size()) >= limits_.files)
            return refuse(fmt::format("the stage has more than {} files (files)", limits_.files));
        std::string text;
        try {
            check_shader_path(normal, folder_);
            if (std::error_code unknown; int64_t(fs::file_size(normal, unknown)) > limits_.text_bytes && !unknown)
                throw Error(too_long());
            text = read_file(normal, uint64_t(limits_.text_bytes));
        } catch (const Error& failure) {
            out_.missing.push_back(normal);
            return refuse(failure.what());
        }
        // An include by another name (a link) is still the same file: else a link to its own folder never ends.
        std::error_code ignored;
        if (!identities_.insert(fs::weakly_canonical(normal, ignored)).second) return;
        int index = int(out_.files.size());
        out_.files.push_back(normal);
        bytes_ += int64_t(text.size());
        if (bytes_ > limits_.text_bytes) return refuse(too_long());
        std::optional<std::string> why_not;
        CodeLines lines(split_lines(text, why_not));
        if (why_not) return error(normal, 0, "", *why_not);
        ++depth_;
        while (std::optional<CodeLine> line = gave_up_ ? std::nullopt : lines.next())
            take_line(*line, index);
        --depth_;
        if (lines.open_comment() && !gave_up_)
            error(normal, lines.open_comment(), "", "this comment does not end: expected */");
    }

    void emit_line(const std::string& line, int file, int number) {
        body_ += line;
        body_ += '\n';
        out_.lines.push_back({file, number});
    }

    void emit(const CodeLine& line, int file) {
        for (size_t i = 0; i < line.written.size(); ++i)
            emit_line(line.written[i], file, line.number + int(i));
    }

    /// In place of a line: a comment that ends in it ends all the same.
    void emit_instead(const CodeLine& line, int file, const std::string& text) {
        if (line.in_comment) emit_line("*/", file, line.number);
        emit_line(text, file, line.number);
    }

    /// What goes through lists of these must not meet a million of them.
    void check_counts(const CodeLine& line, int file) {
        auto check = [&](size_t count, int64_t limit, const char* what) {
            if (int64_t(count) <= limit || gave_up_) return;
            gave_up_ = true;
            error(out_.files[size_t(file)], line.number, line.written.front(),
                  fmt::format("more than {} {}", limit, what));
        };
        check(conditions_.size(), limits_.nesting, "levels of #if (nesting)");
        check(out_.parameters.size(), limits_.parameters, "parameters (parameters)");
        check(out_.slots.size(), limits_.slots, "samplers, images and storage blocks (slots)");
        check(out_.errors.size(), k_max_errors, "errors");
    }

    void take_line(const CodeLine& line, int file) {
        check_counts(line, file);
        std::string_view code = trim(line.code);
        if (line.directive)
            take_directive(std::string(trim(code.substr(1))), line, file);
        else if (code.empty())
            emit(line, file);
        else
            take_code(line, file);
    }

    void take_directive(const std::string& directive, const CodeLine& line, int file) {
        Scanner scanner(directive);
        std::string_view name = scanner.word();
        if (name == "include") {
            take_include(scanner, line, file);
        } else if (name == "version" || name == "line") {
            emit_instead(line, file, "//"); // ours stands at the top; #line would spoil the line table
        } else if (name == "extension") {
            extensions_.push_back("#" + directive); // must come before other code
            emit_instead(line, file, "//");
        } else {
            std::string told = with_static_value(directive);
            follow_condition(told);
            if (told == directive)
                emit(line, file);
            else
                emit_instead(line, file, "#" + told);
        }
    }

    void take_include(Scanner scanner, const CodeLine& line, int file) {
        std::optional<std::string_view> target;
        if (scanner.space().take('"'))
            target = scanner.until('"');
        else if (scanner.take('<'))
            target = scanner.until('>');
        if (!target || target->empty() || !scanner.space().at_end()) {
            error(out_.files[size_t(file)], line.number, line.written.front(),
                  "an include is written #include \"file\"");
            return;
        }
        if (!active()) return emit_instead(line, file, "//"); // once a stage: it must not use up the file's one turn
        if (line.in_comment) emit_line("*/", file, line.number);
        const fs::path includer = out_.files[size_t(file)];
        fs::path beside = includer.parent_path() / *target;
        std::error_code ignored;
        include(fs::exists(beside, ignored) ? beside : folder_ / *target,
                {shown(includer, folder_), line.number, line.written.front(), ""});
    }

    /// "#if name" and "#if !name" over a //! static bool become #if 1 or #if 0: what is behind them is known, too. So
    /// do
    /// "#if name == name_choice", != and >= over a //! static enumeration, by the order of its choices.
    std::string with_static_value(const std::string& directive) const {
        Scanner scanner(directive);
        if (!scanner.take_word("if")) return directive;
        bool negated = scanner.space().take('!');
        const std::string name(scanner.space().word());
        if (auto value = static_bools_.find(name); value != static_bools_.end() && scanner.space().at_end())
            return value->second != negated ? "if 1" : "if 0";
        auto value = static_choices_.find(name);
        if (negated || value == static_choices_.end()) return directive;
        const bool equal = scanner.space().take("=="), unequal = !equal && scanner.take("!=");
        if (!equal && !unequal && !scanner.take(">=")) return directive;
        auto other = choice_values_.find(std::string(scanner.space().word()));
        if (other == choice_values_.end() || !scanner.space().at_end()) return directive;
        const bool same = value->second == other->second;
        const bool holds = equal ? same : unequal ? !same : value->second >= other->second;
        return holds ? "if 1" : "if 0";
    }

    /// Follows #if 0, #if 1 (and so #if over a //! static bool), #ifdef and #ifndef over the names that the text itself
    /// defines, so that slots and parameters behind them are known to be there or not. Other conditions (#if) are left
    /// open: their branches all count.
    void follow_condition(const std::string& directive) {
        Scanner scanner(directive);
        std::string_view kind = scanner.word();
        std::string name(scanner.space().word());
        auto defined = [&] { return defines_.contains(name) || seen_.contains(name); };
        if (kind == "define") {
            if (active()) seen_.insert(name);
        } else if (kind == "undef") {
            if (active()) seen_.erase(name);
        } else if (kind == "ifdef") {
            conditions_.push_back({defined()});
        } else if (kind == "ifndef") {
            conditions_.push_back({!defined()});
        } else if (kind == "if") {
            bool constant = (name == "0" || name == "1") && scanner.space().at_end();
            conditions_.push_back({constant ? std::optional(name == "1") : std::nullopt});
        } else if (conditions_.empty()) {
            return;
        } else if (kind == "else" || kind == "elif") {
            Condition& condition = conditions_.back();
            condition.another_held = condition.another_held || condition.holds.value_or(false);
            bool all_known = condition.holds.has_value();
            condition.holds = std::nullopt;
            if (condition.another_held)
                condition.holds = false;
            else if (kind == "else" && all_known)
                condition.holds = true;
        } else if (kind == "endif") {
            conditions_.pop_back();
        }
    }

    bool active() const {
        return std::none_of(conditions_.begin(), conditions_.end(), [](auto& c) { return c.holds == false; });
    }

    void take_code(const CodeLine& line, int file) {
        if (!active()) return emit(line, file);
        const fs::path path = out_.files[size_t(file)];
        std::string where = fmt::format("{}:{}", shown(path, folder_).string(), line.number);
        ParameterInfo info;
        bool is_parameter = false;
        try {
            is_parameter = line.mark && parse_parameter_line(line.code, *line.mark, info);
        } catch (const Error& failure) {
            error(path, line.number, line.written.front(), failure.what());
        }
        if (!is_parameter) {
            take_slots(line, where, path);
            return emit(line, file);
        }
        info.where = where;
        if (info.is_static) {
            auto value = statics_.find(info.name);
            std::string text = value != statics_.end() ? value->second : static_literal(info, info.default_value);
            const bool named = info.kind == ParameterKind::enumeration;
            // An enumeration is a constant, which names in functions may hide: "#if" over it is followed here.
            emit_instead(line, file,
                         named ? fmt::format("const int {} = {};", info.name, text)
                               : fmt::format("#define {} {}", info.name, text));
            if (text == "true" || text == "false") static_bools_[info.name] = text == "true";
            if (named) static_choices_[info.name] = std::atoi(text.c_str());
        } else {
            emit(line, file);
        }
        bool known = std::any_of(out_.parameters.begin(), out_.parameters.end(),
                                 [&](const ParameterInfo& p) { return p.name == info.name; });
        if (!known) out_.parameters.push_back(info);
        if (!known) name_choices(info);
    }

    /// An enumeration's values by name, as constants above all code: "visibility_cones" is 1.
    void name_choices(const ParameterInfo& info) {
        if (info.kind != ParameterKind::enumeration) return;
        for (size_t i = 0; i < info.choices.size(); ++i) {
            choices_.push_back(fmt::format("const int {}_{} = {};", info.name, info.choices[i], i));
            choice_values_[info.name + "_" + info.choices[i]] = int(i);
        }
    }

    void take_slots(const CodeLine& line, const std::string& where, const fs::path& file) {
        for (auto& [slot, note] : slot_reader_.read(line.code, line.mark.value_or(""))) {
            slot.where = where;
            slot.certain =
                std::all_of(conditions_.begin(), conditions_.end(), [](auto& c) { return c.holds.has_value(); });
            try {
                if (!note.empty()) read_slot_note(note, slot);
            } catch (const Error& failure) {
                error(file, line.number, line.written.front(), failure.what());
            }
            if (slot.name.find('.') == std::string::npos) {
                error(file, line.number, line.written.front(),
                      fmt::format("'{0}' is no name for a resource: write it with an underscore, as group_{0}, for the "
                                  "resource group.{0}",
                                  shortened(slot.identifier)));
                continue;
            }
            bool known = std::any_of(out_.slots.begin(), out_.slots.end(),
                                     [&own = slot](const ShaderSlot& s) { return s.identifier == own.identifier; });
            if (!known) out_.slots.push_back(std::move(slot));
        }
    }

    const ShaderLimits& limits_ = shader_limits();
    std::map<std::string, bool> static_bools_;
    std::map<std::string, int> static_choices_; ///< of //! static enumerations: the value's place among the choices
    std::map<std::string, int> choice_values_;  ///< "visibility_cones" → 1
    std::vector<std::string> choices_;          ///< constants that name the enumerations' values
    fs::path folder_;
    const Defines& defines_;
    const Defines& statics_;
    ShaderSource out_;
    std::string body_;
    std::vector<std::string> extensions_;
    std::set<std::string> seen_;        ///< names that #define lines so far have defined
    std::vector<Condition> conditions_; ///< from the outermost in
    SlotReader slot_reader_;
    std::set<fs::path> identities_; ///< of the files so far, links followed
    int depth_ = 0;
    int64_t bytes_ = 0;
    bool gave_up_ = false; ///< beyond a limit, told once
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

ShaderSource expand_shader(const fs::path& file, const fs::path& folder, const Defines& defines,
                           const Defines& static_values) {
    return Expander(folder, defines, static_values).run(folder / file);
}

} // namespace bounce
