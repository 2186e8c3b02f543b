// The overlay that leads from one whole graph to another, and the text of graph files.
#include "core/text.h"
#include "graph/graph_overlay.h"

#include <algorithm>
#include <set>

namespace bounce {

static bool are_equal(const OrderedJson& a, const OrderedJson& b) {
    return nlohmann::json(a) == nlohmann::json(b); // members have no order
}

static OrderedJson member(const OrderedJson& object, const std::string& key) {
    auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : OrderedJson::object();
}

/// Members that differ, and null for those that are gone. Members that `nested` names are compared the same way.
static OrderedJson changed_fields(const OrderedJson& from, const OrderedJson& to,
                                  const std::vector<std::string>& nested) {
    OrderedJson changes = OrderedJson::object();
    for (const auto& [key, value] : to.items()) {
        if (from.contains(key) && are_equal(from[key], value)) continue;
        bool is_nested = std::find(nested.begin(), nested.end(), key) != nested.end();
        changes[key] = is_nested && from.contains(key) ? changed_fields(from[key], value, {}) : value;
    }
    for (const auto& [key, value] : from.items())
        if (!to.contains(key)) changes[key] = nullptr;
    return changes;
}

/// Of passes that are in both, those that keep their order: the longest such row.
static std::set<std::string> keeping_order(const std::vector<std::string>& from, const std::vector<std::string>& to) {
    std::vector<std::vector<size_t>> longest(from.size() + 1, std::vector<size_t>(to.size() + 1, 0));
    for (size_t i = from.size(); i-- > 0;) {
        for (size_t j = to.size(); j-- > 0;)
            longest[i][j] =
                from[i] == to[j] ? longest[i + 1][j + 1] + 1 : std::max(longest[i + 1][j], longest[i][j + 1]);
    }
    std::set<std::string> kept;
    for (size_t i = 0, j = 0; i < from.size() && j < to.size();) {
        if (from[i] == to[j])
            kept.insert(from[i]), ++i, ++j;
        else if (longest[i + 1][j] >= longest[i][j + 1])
            ++i;
        else
            ++j;
    }
    return kept;
}

static OrderedJson without(OrderedJson entry, const char* key) {
    entry.erase(key);
    return entry;
}

static void add_passes(OrderedJson& overlay, const OrderedJson& from, const OrderedJson& to) {
    std::map<std::string, const OrderedJson*> old, wanted;
    std::vector<std::string> before, after;
    for (const OrderedJson& entry : to)
        wanted[pass_id(entry)] = &entry;
    OrderedJson removed = OrderedJson::array();
    for (const OrderedJson& entry : from) {
        std::string id = pass_id(entry);
        auto found = wanted.find(id);
        // A pass of another type is another pass.
        if (found != wanted.end() && (*found->second)["type"] == entry["type"])
            old[id] = &entry, before.push_back(id);
        else
            removed.push_back(id);
    }
    for (const OrderedJson& entry : to)
        after.push_back(pass_id(entry));
    std::set<std::string> kept = keeping_order(before, after);
    OrderedJson passes = OrderedJson::array();
    std::string last; // the entry before, in the overlay
    for (size_t i = 0; i < after.size(); ++i) {
        const std::string& id = after[i];
        OrderedJson entry = OrderedJson::object();
        bool moves = !kept.contains(id);
        if (moves && i == 0) {
            auto anchor = std::find_if(after.begin(), after.end(), [&](auto& a) { return kept.contains(a); });
            if (anchor != after.end()) entry["before"] = *anchor;
        } else if (moves && after[i - 1] != last) {
            entry["after"] = after[i - 1];
        }
        if (!old.contains(id)) {
            entry.update(*wanted[id]);
        } else {
            OrderedJson changes =
                changed_fields(without(*old[id], "id"), without(*wanted[id], "id"), {"params", "bind"});
            if (changes.empty() && !moves) continue;
            entry["id"] = id;
            entry.update(changes);
            if (moves && !entry.contains("before") && !entry.contains("after")) entry["after"] = after[i - 1];
        }
        passes.push_back(entry);
        last = id;
    }
    if (!removed.empty()) overlay["remove"] = removed;
    if (!passes.empty()) overlay["passes"] = passes;
}

OrderedJson graph_departures(const OrderedJson& from, const OrderedJson& to) {
    OrderedJson overlay = OrderedJson::object();
    if (from.value("about", "") != to.value("about", "")) overlay["about"] = to.value("about", "");
    OrderedJson transport = changed_fields(member(from, "transport"), member(to, "transport"), {});
    if (!transport.empty()) overlay["transport"] = transport;
    for (const char* kind : {"parameters", "resources"}) {
        OrderedJson changes = OrderedJson::object();
        OrderedJson a = member(from, kind), b = member(to, kind);
        std::vector<std::string> names;
        for (const auto& [name, value] : b.items())
            names.push_back(name);
        changes = changed_fields(a, b, names);
        if (!changes.empty()) overlay[kind] = changes;
    }
    add_passes(overlay, member(from, "passes"), member(to, "passes"));
    return overlay;
}

// --- text ------------------------------------------------------------------------------------------------------------

static constexpr size_t k_columns = 140;

std::string on_one_line(const OrderedJson& value) {
    if (!value.is_structured()) return value.dump();
    std::vector<std::string> parts;
    for (const auto& [key, member] : value.items())
        parts.push_back((value.is_object() ? OrderedJson(key).dump() + ": " : "") + on_one_line(member));
    if (parts.empty()) return value.is_object() ? "{}" : "[]";
    return value.is_object() ? "{ " + join(parts, ", ") + " }" : "[" + join(parts, ", ") + "]";
}

/// Columns, not bytes.
static size_t width_of(const std::string& text) {
    return size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// One line if it fits behind what stands before it, with `reserve` columns for what closes behind it; else its members
/// fill lines.
static std::string filled(const OrderedJson& value, size_t column, size_t reserve = 1) {
    std::string line = on_one_line(value);
    if (!value.is_structured() || column + width_of(line) + reserve <= k_columns) return line;
    reserve += 2;
    std::string text = value.is_object() ? "{ " : "[";
    size_t indent = column + text.size(), at = indent;
    bool first = true;
    for (const auto& [key, member] : value.items()) {
        std::string name = value.is_object() ? "\"" + key + "\": " : "";
        size_t whole = width_of(name + on_one_line(member));
        if (!first) text += ",", at += 1;
        if (!first && at + 1 + whole + reserve > k_columns) {
            text += "\n" + std::string(indent, ' ');
            at = indent;
        } else if (!first) {
            text += " ", at += 1;
        }
        std::string part = name + filled(member, at + width_of(name), reserve);
        text += part;
        size_t newline = part.rfind('\n');
        at = newline == std::string::npos ? at + width_of(part) : width_of(part.substr(newline + 1));
        first = false;
    }
    return text + (value.is_object() ? " }" : "]");
}

std::string graph_text(const OrderedJson& root) {
    std::vector<std::string> members;
    for (const auto& [key, value] : root.items()) {
        std::string text = "  \"" + key + "\": ";
        bool rows =
            value.is_structured() && !value.empty() && (key == "parameters" || key == "resources" || key == "passes");
        if (!rows) {
            members.push_back(text + filled(value, text.size()));
            continue;
        }
        std::vector<std::string> lines;
        for (const auto& [name, member] : value.items()) {
            std::string head = value.is_object() ? "    \"" + name + "\": " : "    ";
            lines.push_back(head + filled(member, head.size()));
        }
        members.push_back(text + (value.is_object() ? "{\n" : "[\n") + join(lines, ",\n") +
                          (value.is_object() ? "\n  }" : "\n  ]"));
    }
    return "{\n" + join(members, ",\n") + "\n}\n";
}

} // namespace bounce
