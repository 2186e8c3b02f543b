#include "gpu/glsl_structure.h"

#include "gpu/glsl_constants.h"
#include "gpu/glsl_types.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace bounce {

namespace {

using Range = std::pair<size_t, size_t>; ///< tokens from the first to before the second

using Storage = GlslStorage;

class Structure {
  public:
    Structure(const std::vector<GlslToken>& tokens, const ShaderLimits& limits) : tokens_(tokens), limits_(limits) {}

    GlslOutline run() {
        check_nesting(tokens_, limits_);
        for (size_t at = 0; at < tokens_.size();)
            at = external(at);
        check_calls(outline_.functions, limits_);
        return std::move(outline_);
    }

  private:
    // --- tokens ---

    std::string_view text(size_t at) const { return at < tokens_.size() ? tokens_[at].text : std::string_view(); }
    bool is_word(size_t at) const { return at < tokens_.size() && tokens_[at].is_word(); }
    int line(size_t at) const { return tokens_.empty() ? 0 : tokens_[std::min(at, tokens_.size() - 1)].line; }
    [[noreturn]] void beyond(size_t at, const std::string& what) const { throw BeyondLimit(line(at), what); }

    /// Behind the bracket that closes the one at `at`.
    size_t closed(size_t at) const {
        int depth = 0;
        for (; at < tokens_.size(); ++at) {
            depth += bracket_of(text(at));
            if (depth == 0) return at + 1;
        }
        return at;
    }

    /// The first of `wanted` at or after `at`, outside of brackets that open there; the end when there is none.
    size_t find_outside(size_t at, std::string_view wanted) const {
        for (int depth = 0; at < tokens_.size(); ++at) {
            if (depth == 0 && text(at).size() == 1 && wanted.find(text(at)[0]) != std::string_view::npos) return at;
            depth = std::max(0, depth + bracket_of(text(at)));
        }
        return at;
    }

    // --- outside of functions ---

    size_t external(size_t at) {
        size_t end = find_outside(at, ";{}");
        if (text(end) == "{") {
            Range head{at, end};
            if (contains(head, "=")) { // a list of initial values
                end = find_outside(end, ";");
            } else if (contains(head, "struct")) {
                return structure(at, end, Storage::global);
            } else if (end > at && text(end - 1) == ")") {
                return function(at, end);
            } else {
                return block(at, end);
            }
        }
        declaration({at, end}, storage_of({at, end}, Storage::global));
        return end + 1;
    }

    bool contains(Range range, std::string_view word) const {
        int depth = 0;
        for (size_t at = range.first; at < range.second; ++at) {
            depth += bracket_of(text(at));
            if (depth == 0 && text(at) == word) return true;
        }
        return false;
    }

    Storage storage_of(Range range, Storage otherwise) const {
        if (contains(range, "shared")) return Storage::shared_memory;
        if (contains(range, "uniform")) return Storage::uniform;
        if (contains(range, "buffer")) return Storage::buffer;
        return otherwise;
    }

    /// The members between the braces, added up.
    GlslSize members(size_t open, std::vector<std::string_view>* names = nullptr) {
        GlslSize sum{0, 0, true};
        size_t end = closed(open);
        for (size_t at = open + 1; at + 1 < end;) {
            size_t semicolon = std::min(find_outside(at, ";}"), end - 1);
            for (const auto& [name, size] : declared({at, semicolon})) {
                sum.bytes += size.bytes;
                sum.names += size.names;
                if (names) names->push_back(text(name));
            }
            at = semicolon + 1;
        }
        return sum;
    }

    /// "struct S { … } a, b;" from its first token; `open`: its brace.
    size_t structure(size_t at, size_t open, Storage storage) {
        GlslSize size = members(open);
        if (is_word(open - 1) && text(open - 1) != "struct") types_.define(text(open - 1), size);
        size_t end = find_outside(closed(open), ";{}");
        for (const auto& [name, variable] : declarators(closed(open), end, size)) {
            account(name, variable, storage_of({at, open}, storage));
            if (storage != Storage::local)
                outline_.variables.push_back({text(name), "struct", storage_of({at, open}, storage), variable.bytes,
                                              size.bytes > 0 ? variable.bytes / size.bytes : 1,
                                              contains({at, open}, "out")});
        }
        return end + 1;
    }

    /// "layout(…) buffer B { … } name[4];"
    size_t block(size_t at, size_t open) {
        Storage storage = storage_of({at, open}, Storage::global);
        GlslBlock found{text(open - 1), storage, 0, {}};
        GlslSize size = members(open, &found.means);
        size_t end = find_outside(closed(open), ";{}");
        if (closed(open) != end) {
            for (const auto& [name, whole] : declarators(closed(open), end, size)) {
                size = whole;
                found.means = {text(name)};
            }
        }
        found.bytes = size.bytes;
        outline_.blocks.push_back(std::move(found));
        int64_t limit = storage == Storage::buffer ? limits_.buffer_bytes : limits_.uniform_bytes;
        const char* limit_name = storage == Storage::buffer ? "buffer_bytes" : "uniform_bytes";
        if (size.bytes > double(limit))
            beyond(open, fmt::format("the block '{}' holds {:.4g} bytes: expected at most {} ({})", text(open - 1),
                                     size.bytes, limit, limit_name));
        add_names(open, size.names);
        return text(end) == ";" ? end + 1 : end;
    }

    void add_names(size_t at, double names) {
        names_ += names;
        if (names_ > double(limits_.interface_names))
            beyond(at, fmt::format("uniforms and blocks have {:.4g} names, each element of an array of structures one: "
                                   "expected at most {} (interface_names)",
                                   names_, limits_.interface_names));
    }

    // --- declarations ---

    std::optional<double> constant(Range range) const {
        range.second = std::min(range.second, tokens_.size());
        if (range.first >= range.second) return std::nullopt;
        return constant_value(std::span(tokens_).subspan(range.first, range.second - range.first),
                              [&](std::string_view name) -> std::optional<double> {
                                  auto found = constants_.find(name);
                                  return found == constants_.end() ? std::nullopt : std::optional(found->second);
                              });
    }

    /// "[4][n]" from `at` on: the product of the sizes that are known.
    double dimensions(size_t& at) const {
        double count = 1;
        while (text(at) == "[") {
            size_t end = closed(at);
            if (end > at + 2) count *= std::max(1.0, constant({at + 1, end - 1}).value_or(1));
            at = end;
        }
        return count;
    }

    using Variables = std::vector<std::pair<size_t, GlslSize>>; ///< where the name is, and its size

    /// "a[4], b = 1" behind a type.
    Variables declarators(size_t at, size_t end, const GlslSize& type) const {
        Variables variables;
        while (at < end && is_word(at)) {
            size_t name = at++;
            double count = dimensions(at);
            variables.push_back({name, array_of(type, count)});
            at = std::min(find_outside(at, ",;"), end);
            if (text(at) != "," || at >= end) break;
            ++at;
        }
        return variables;
    }

    /// The type of a declaration: behind qualifiers and layout(…). nullopt when the text begins with no type.
    std::optional<size_t> type_at(Range range) const {
        static const std::set<std::string_view> qualifiers = {
            "const",    "in",        "out",           "inout",    "uniform",   "buffer",   "shared",
            "flat",     "smooth",    "noperspective", "centroid", "sample",    "patch",    "invariant",
            "precise",  "highp",     "mediump",       "lowp",     "coherent",  "volatile", "restrict",
            "readonly", "writeonly", "attribute",     "varying",  "subroutine"};
        size_t at = range.first;
        while (at < range.second) {
            if (text(at) == "layout" && text(at + 1) == "(")
                at = closed(at + 1);
            else if (qualifiers.contains(text(at)))
                ++at;
            else
                return types_.find(text(at)) ? std::optional(at) : std::nullopt;
        }
        return std::nullopt;
    }

    Variables declared(Range range) const {
        std::optional<size_t> type = type_at(range);
        if (!type) return {};
        size_t at = *type + 1;
        double count = dimensions(at);
        return declarators(at, range.second, array_of(*types_.find(text(*type)), count));
    }

    void declaration(Range range, Storage storage) {
        array_constructors(range);
        Variables variables = declared(range);
        bool is_const = contains(range, "const");
        for (const auto& [name, size] : variables) {
            size_t equals = name + 1;
            dimensions(equals);
            constants_.erase(text(name));
            initial_.erase(text(name));
            const bool hides = !declared_.insert(text(name)).second;
            if (hides) outline_.constants.erase(text(name));
            if (storage != Storage::local && !is_const) {
                const GlslSize& type = *types_.find(text(*type_at(range)));
                outline_.variables.push_back({text(name), text(*type_at(range)), storage, size.bytes,
                                              type.bytes > 0 ? size.bytes / type.bytes : 1, contains(range, "out")});
            }
            if (text(equals) == "=") {
                const auto value = constant({equals + 1, std::min(find_outside(equals, ",;"), range.second)});
                if (value) initial_[text(name)] = *value;
                if (value && is_const) constants_[text(name)] = *value;
                if (value && is_const && storage == Storage::global && !hides) outline_.constants[text(name)] = *value;
            }
            account(name, size, storage);
        }
        // The result of a function that is only named here.
        if (std::optional<size_t> type = type_at(range); type && variables.empty()) {
            size_t at = *type + 1;
            account(*type, array_of(*types_.find(text(*type)), dimensions(at)), Storage::local);
        }
    }

    /// "float[](1.0, 2.0)", "float[1000000](…)" anywhere in an expression.
    void array_constructors(Range range) {
        for (size_t at = range.first; at + 1 < range.second; ++at) {
            const GlslSize* type = text(at + 1) == "[" ? types_.find(text(at)) : nullptr;
            if (!type) continue;
            size_t end = at + 1;
            double count = dimensions(end);
            bool unnamed = text(end) == "(" || text(end) == "," || text(end) == ")"; // a value, or a parameter
            if (unnamed && type->bytes * count > double(limits_.private_bytes))
                account(at, array_of(*type, count), Storage::local);
        }
    }

    void account(size_t name, const GlslSize& size, Storage storage) {
        auto add = [&](double& sum, int64_t limit, const char* what, const char* limit_name) {
            sum += size.bytes;
            if (sum <= double(limit)) return;
            beyond(name, fmt::format("'{}' holds {:.4g} bytes, {} {:.4g} in all: expected at most {} ({})", text(name),
                                     size.bytes, what, sum, limit, limit_name));
        };
        switch (storage) {
        case Storage::local:
            return add(local_bytes_, limits_.private_bytes, "the variables of its function", "private_bytes");
        case Storage::global:
            return add(global_bytes_, limits_.private_bytes, "the global variables", "private_bytes");
        case Storage::shared_memory:
            return add(shared_bytes_, limits_.shared_bytes, "the shared variables", "shared_bytes");
        case Storage::uniform:
            add_names(name, size.names);
            return add(uniform_bytes_, limits_.uniform_bytes, "the uniforms", "uniform_bytes");
        case Storage::buffer:
            return;
        }
    }

    // --- functions ---

    size_t function(size_t at, size_t body) {
        local_bytes_ = 0;
        initial_.clear();
        size_t open = find_outside(at, "(");
        while (open < body && closed(open) != body) // layout(…) and the like come before
            open = find_outside(closed(open), "(");
        if (open >= body || open == at) return statement(body, 0, 1);
        std::string_view name = text(open - 1);
        declaration({at, open - 1}, Storage::local);
        for (size_t first = open + 1; first + 1 < body;) {
            size_t end = std::min(find_outside(first, ","), body - 1);
            declaration({first, end}, Storage::local);
            first = end + 1;
        }
        size_t end = statement(body, 0, 1);
        GlslFunction& own =
            outline_.functions.emplace_back(GlslFunction{name, line(at), double(end - body), {}, body, end});
        for (size_t i = body; i + 1 < end; ++i)
            if (is_word(i) && text(i + 1) == "(") own.calls.push_back(text(i));
        return end;
    }

    /// `rounds`: how often the loops around it run, as far as they are constant. Returns what comes behind.
    size_t statement(size_t at, int64_t depth, double rounds) {
        if (depth > limits_.nesting)
            beyond(at, fmt::format("statements are nested more than {} deep (nesting)", limits_.nesting));
        std::string_view t = text(at);
        if (t == "{") {
            for (++at; at < tokens_.size() && text(at) != "}";)
                at = statement(at, depth + 1, rounds);
            return at + 1;
        }
        if (t == "if" && text(at + 1) == "(") {
            at = statement(closed(at + 1), depth + 1, rounds);
            return text(at) == "else" ? statement(at + 1, depth + 1, rounds) : at;
        }
        if (t == "for" && text(at + 1) == "(") return for_loop(at, depth, rounds);
        if (t == "while" && text(at + 1) == "(") {
            size_t body = closed(at + 1);
            size_t end = statement(body, depth + 1, rounds);
            Range condition{at + 2, body - 1};
            check_rounds(at, rounds * rounds_of(condition, {body, end}));
            return end;
        }
        if (t == "do") {
            size_t end = statement(at + 1, depth + 1, rounds);
            if (text(end) != "while" || text(end + 1) != "(") return end;
            Range condition{end + 2, closed(end + 1) - 1};
            check_rounds(at, rounds * rounds_of(condition, {at + 1, end}));
            return find_outside(closed(end + 1), ";{}") + 1;
        }
        if (t == "switch" && text(at + 1) == "(") return statement(closed(at + 1), depth + 1, rounds);
        if (t == "case" || t == "default") return find_outside(at, ":;{}") + 1;
        if (t == "else" || t == "}") return at + 1; // lost: for the driver to tell
        size_t end = find_outside(at, ";{}");
        if (text(end) == "{" && contains({at, end}, "struct")) return structure(at, end, Storage::local);
        if (text(end) == "{" && contains({at, end}, "=")) end = find_outside(end, ";");
        if (text(at + 1) == "=") initial_.erase(t);
        declaration({at, end}, Storage::local);
        return text(end) == ";" ? end + 1 : std::max(end, at + 1);
    }

    size_t for_loop(size_t at, int64_t depth, double rounds) {
        size_t end = closed(at + 1); // behind the header
        size_t first = find_outside(at + 2, ";"), second = find_outside(first + 1, ";");
        if (second >= end) return statement(end, depth + 1, rounds);
        declaration({at + 2, first}, Storage::local);
        double own = rounds_of({first + 1, second}, {second + 1, end - 1});
        check_rounds(at, rounds * own);
        return statement(end, depth + 1, rounds * own);
    }

    void check_rounds(size_t at, double rounds) const {
        if (rounds > double(limits_.loop_iterations))
            beyond(at, fmt::format(
                           "this loop runs {:.4g} times with those around it: expected at most {} (loop_iterations)",
                           rounds, limits_.loop_iterations));
    }

    /// How often "i < n" holds when i begins at a known value and `steps` changes it by a constant; 1 when that is not
    /// known.
    double rounds_of(Range condition, Range steps) const {
        for (size_t at = condition.first; at < condition.second; ++at) {
            std::string_view op = text(at);
            if (op != "<" && op != "<=" && op != ">" && op != ">=" && op != "!=") continue;
            for (bool turned : {false, true}) {
                Range left{condition.first, at}, right{at + 1, condition.second};
                if (turned) std::swap(left, right);
                if (left.second - left.first != 1) continue;
                auto begin = initial_.find(text(left.first));
                auto bound = constant(right);
                if (begin == initial_.end() || !bound) continue;
                return rounds_between(begin->second, *bound, text(left.first), steps);
            }
        }
        return 1;
    }

    double rounds_between(double begin, double bound, std::string_view name, Range steps) const {
        for (size_t at = steps.first; at < steps.second; ++at) {
            if (text(at) != name) continue;
            std::string_view before = at > steps.first ? text(at - 1) : "", after = text(at + 1);
            if (before == "++" || after == "++" || before == "--" || after == "--") return std::abs(bound - begin) + 1;
            size_t value = at + 2;
            bool plain = after == "=" && text(at + 2) == name; // i = i + 2
            if (plain) after = text(at + 3), value = at + 4;
            auto step = constant({value, std::min(find_outside(value, ",;"), steps.second)});
            if (!step || *step == 0) continue;
            if (after == "+=" || after == "-=" || (plain && (after == "+" || after == "-")))
                return std::abs(bound - begin) / std::abs(*step) + 1;
        }
        return 1; // i *= 2 and the like are soon over
    }

    const std::vector<GlslToken>& tokens_;
    const ShaderLimits& limits_;
    GlslTypes types_;
    std::map<std::string_view, double> constants_; ///< const variables whose value is known
    std::map<std::string_view, double> initial_;   ///< what the function's variables began with
    std::set<std::string_view> declared_;          ///< names of variables so far
    GlslOutline outline_;
    double local_bytes_ = 0, global_bytes_ = 0, shared_bytes_ = 0, uniform_bytes_ = 0, names_ = 0;
};

} // namespace

GlslOutline check_structure(const std::vector<GlslToken>& tokens, const ShaderLimits& limits) {
    return Structure(tokens, limits).run();
}

} // namespace bounce
