#include "core/json_edit.h"

#include "core/error.h"

#include <cctype>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace bounce {

namespace {

/// What ends a comment that begins with two slashes, as the reader of JSON has it.
constexpr std::string_view k_line_ends("\n\r");

/// A value and where it stands in the text.
struct Value {
    char kind = 'v'; ///< '{', '[' or a plain value
    size_t begin = 0, end = 0;
    std::vector<std::string> names; ///< of an object's members
    std::vector<size_t> starts;     ///< of its members (at their names) or elements
    std::vector<Value> children;
};

class Locator {
  public:
    explicit Locator(const std::string& text) : text_(text), at_(text.starts_with("\xEF\xBB\xBF") ? 3 : 0) {}

    Value read() {
        skip();
        Value value;
        value.begin = at_;
        char first = peek();
        if (first == '{' || first == '[') {
            value.kind = first;
            ++at_;
            for (skip(); peek() != '}' && peek() != ']'; skip()) {
                value.starts.push_back(at_);
                if (first == '{') {
                    size_t start = at_;
                    read_text();
                    value.names.push_back(unescaped(text_.substr(start, at_ - start)));
                    skip();
                    ++at_; // the colon
                }
                value.children.push_back(read());
                skip();
                if (peek() == ',') ++at_;
            }
            ++at_;
        } else if (first == '"') {
            read_text();
        } else {
            size_t start = at_;
            while (at_ < text_.size() && std::string_view(",]}/").find(text_[at_]) == std::string_view::npos &&
                   !std::isspace(static_cast<unsigned char>(text_[at_])))
                ++at_;
            if (at_ == start) throw Error("not JSON");
        }
        value.end = at_;
        return value;
    }

  private:
    char peek() const {
        if (at_ >= text_.size()) throw Error("not JSON: it ends too early");
        return text_[at_];
    }
    void skip() {
        while (at_ < text_.size()) {
            if (std::isspace(static_cast<unsigned char>(text_[at_])))
                ++at_;
            else if (text_.compare(at_, 2, "//") == 0)
                at_ = std::min(text_.find_first_of(k_line_ends, at_), text_.size());
            else if (text_.compare(at_, 2, "/*") == 0)
                at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
            else
                return;
        }
    }
    void read_text() {
        for (++at_; peek() != '"'; ++at_)
            if (peek() == '\\') ++at_;
        ++at_;
    }

    /// What a text in quotes stands for.
    static std::string unescaped(const std::string& quoted) { return nlohmann::json::parse(quoted).get<std::string>(); }

    const std::string& text_;
    size_t at_;
};

const Value* child(const Value& value, const std::string& name) {
    for (size_t i = 0; i < value.children.size(); ++i) {
        if (value.kind == '{' ? value.names[i] == name : std::to_string(i) == name) return &value.children[i];
    }
    return nullptr;
}

/// The white space with which the line of `at` begins, if nothing else stands before `at`.
bool starts_line(const std::string& text, size_t at, std::string& indent) {
    size_t line = text.rfind('\n', at == 0 ? 0 : at - 1);
    size_t begin = line == std::string::npos ? 0 : line + 1;
    indent = text.substr(begin, at - begin);
    return indent.find_first_not_of(" \t") == std::string::npos && line != std::string::npos;
}

/// Puts `item` into an object or list, before child `before` or at its end.
void add_child(std::string& text, const Value& parent, size_t before, const std::string& item) {
    std::string indent;
    if (parent.children.empty()) {
        text.insert(parent.begin + 1, parent.kind == '[' ? item : " " + item + " ");
    } else if (before < parent.children.size()) {
        size_t at = parent.starts[before];
        text.insert(at, item + (starts_line(text, at, indent) ? ",\n" + indent : ", "));
    } else {
        size_t end = parent.children.back().end;
        if (!starts_line(text, parent.starts.back(), indent)) {
            text.insert(end, ", " + item);
            return;
        }
        // A comment behind the last child stays with it.
        size_t line_end = std::min(text.find_first_of(k_line_ends, end), text.size());
        size_t rest = text.find_first_not_of(" \t", end);
        bool comment = rest != std::string::npos && rest < line_end && text.compare(rest, 2, "//") == 0;
        text.insert(comment ? line_end : end, "\n" + indent + item);
        text.insert(end, ",");
    }
}

/// The value at a path, with its members and elements made on the way: those that lack are put in as `made`.
Value reach(std::string& text, const std::vector<std::string>& path, const char* made) {
    Value value = Locator(text).read();
    for (size_t depth = 0; depth < path.size();) {
        if (value.kind == 'v') throw Error(fmt::format("'{}' is in no object or list", path[depth]));
        if (const Value* found = child(value, path[depth])) {
            Value next = *found;
            value = std::move(next);
            ++depth;
            continue;
        }
        if (value.kind != '{') throw Error(fmt::format("there is no element {}", path[depth]));
        add_child(text, value, value.children.size(),
                  nlohmann::json(path[depth]).dump() + ": " + (depth + 1 == path.size() ? made : "{}"));
        value = Locator(text).read();
        depth = 0;
    }
    return value;
}

} // namespace

void JsonEdit::set(const std::vector<std::string>& path, const std::string& value) {
    Value found = reach(text_, path, "null");
    text_.replace(found.begin, found.end - found.begin, value);
}

void JsonEdit::insert(const std::vector<std::string>& path, size_t before, const std::string& value) {
    Value list = reach(text_, path, "[]");
    if (list.kind != '[') throw Error(fmt::format("'{}' is no list", path.back()));
    add_child(text_, list, before, value);
}

} // namespace bounce
