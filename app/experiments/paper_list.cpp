#include "app/experiments/paper_list.h"

#include "app/experiments/table_file.h"
#include "core/paths.h"
#include "core/printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace bounce {

using nlohmann::ordered_json;

std::filesystem::path paper_list_path() {
    return assets_folder() / "results" / "papers.json";
}

namespace {

/// 1 … 39, as papers count tables.
std::string roman(int number) {
    std::string out;
    for (const auto& [value, text] : {std::pair(10, "X"), {9, "IX"}, {5, "V"}, {4, "IV"}, {1, "I"}}) {
        for (; number >= value; number -= value)
            out += text;
    }
    return out;
}

int count_at(const ordered_json& json, const char* key, const std::string& where, ErrorList& errors) {
    if (json.contains(key) && json[key].is_number_integer() && json[key] >= 0 && json[key] < 40) return json[key];
    errors.add(fmt::format("{}: invalid '{}': expected a whole number from 0 to 39", where, key));
    return 0;
}

PaperItem read_item(const ordered_json& json, const std::string& where, ErrorList& errors) {
    PaperItem item;
    if (!json.is_object()) {
        errors.add(where + " must be an object {…}");
        return item;
    }
    item.item = text_at(json, "item", where, errors, true);
    const std::string own = where + " (" + item.item + ")";
    check_keys(json, own, {"item", "shows", "command", "result", "note", "reason"}, errors);
    item.shows = text_at(json, "shows", own, errors, true);
    item.command = text_at(json, "command", own, errors, false);
    item.result = text_at(json, "result", own, errors, false);
    item.note = text_at(json, "note", own, errors, false);
    item.reason = text_at(json, "reason", own, errors, false);
    if (item.result.empty() == item.reason.empty())
        errors.add(own + ": expected either a 'result', or the 'reason' why there is none");
    if (!item.result.empty() && item.command.empty())
        errors.add(own + ": expected the 'command' that makes the result");
    std::error_code ignored;
    if (!item.result.empty() && !std::filesystem::is_regular_file(assets_folder() / "results" / item.result, ignored))
        errors.add(fmt::format("{}: there is no result '{}': expected a path from assets/results", own, item.result));
    return item;
}

/// That each figure and table stands there once.
void check_numbers(const Paper& paper, int figures, int tables, ErrorList& errors) {
    std::map<std::string, int> named;
    for (const PaperItem& item : paper.items)
        ++named[item.item];
    const auto expect = [&](const std::string& name, const std::string& other) {
        const int times = named[name] + (other == name ? 0 : named[other]);
        if (times != 1) errors.add(fmt::format("{}: {} is named {} times: expected once", paper.name, name, times));
        named.erase(name);
        named.erase(other);
    };
    for (int i = 1; i <= figures; ++i)
        expect(fmt::format("Figure {}", i), fmt::format("Figure {}", i));
    for (int i = 1; i <= tables; ++i)
        expect(fmt::format("Table {}", i), "Table " + roman(i));
    for (const auto& [name, times] : named)
        errors.add(fmt::format("{}: invalid item '{}': expected Figure 1 … {} or Table 1 … {}", paper.name, name,
                               figures, tables));
}

} // namespace

PaperList load_paper_list(const std::filesystem::path& path) {
    const ordered_json json = read_table(path);
    ErrorList errors;
    PaperList list;
    check_keys(json, path.filename().string(), {"about", "papers"}, errors);
    list.about = text_at(json, "about", path.filename().string(), errors, false);
    size_t index = 0;
    if (!json.contains("papers") || !json["papers"].is_array())
        throw Error(path.string() + ": expected a list \"papers\"");
    for (const ordered_json& entry : json["papers"]) {
        const std::string where = fmt::format("papers[{}]", index++);
        if (!entry.is_object() || !entry.contains("items") || !entry["items"].is_array()) {
            errors.add(where + " must be {\"name\": …, \"items\": […]}");
            continue;
        }
        Paper& paper = list.papers.emplace_back();
        check_keys(entry, where, {"name", "title", "figures", "tables", "items"}, errors);
        paper.name = text_at(entry, "name", where, errors, true);
        paper.title = text_at(entry, "title", where, errors, true);
        for (const ordered_json& item : entry["items"])
            paper.items.push_back(read_item(item, paper.name, errors));
        check_numbers(paper, count_at(entry, "figures", where, errors), count_at(entry, "tables", where, errors),
                      errors);
    }
    errors.throw_if_any(path.string());
    return list;
}

std::string paper_list_markdown(const PaperList& list) {
    std::string out = list.about + "\n";
    for (const Paper& paper : list.papers) {
        const auto made =
            std::count_if(paper.items.begin(), paper.items.end(), [](auto& i) { return !i.result.empty(); });
        out += fmt::format(
            "\n## {}\n\n{}: {} of {} are linked.\n\n| theirs | shows | command | ours |\n| --- | --- | --- | "
            "--- |\n",
            paper.name, paper.title, made, paper.items.size());
        for (const PaperItem& item : paper.items) {
            const std::string command = item.command.empty() ? "–" : "`" + markdown_cell(item.command) + "`";
            const std::string ours =
                item.result.empty()
                    ? markdown_cell(item.reason)
                    : fmt::format("[{}]({})", std::filesystem::path(item.result).filename().string(), item.result) +
                          (item.note.empty() ? "" : ": " + markdown_cell(item.note));
            out += fmt::format("| {} | {} | {} | {} |\n", item.item, markdown_cell(item.shows), command, ours);
        }
    }
    return out;
}

} // namespace bounce
