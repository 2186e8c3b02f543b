#include "app/experiments/page_data.h"

#include "core/json_text.h"
#include "core/printable.h"

#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

std::string joined(const char* open, const std::vector<std::string>& values, const char* close) {
    std::string out = open;
    for (const std::string& value : values)
        out += (&value == &values.front() ? "" : ",") + value;
    return out + close;
}

template <class List, class ToText>
std::string list_of(const List& list, const ToText& to_text) {
    std::vector<std::string> values;
    for (const auto& one : list)
        values.push_back(to_text(one));
    return data_list(values);
}

/// Pairs keep their order and may share a name.
std::string pairs(const NamedTexts& texts) {
    return list_of(texts, [](const auto& one) { return data_list({data_text(one.first), data_text(one.second)}); });
}

std::string titled(const PageCost& one) {
    return data_object({{"key", data_text(one.key)}, {"title", data_text(one.title)}});
}

std::string error_data(const PageError& error) {
    std::vector<std::pair<std::string, std::string>> members = {
        {"key", data_text(error.key)}, {"title", data_text(error.title)}, {"share", error.share ? "true" : "false"}};
    if (!error.joint_key.empty()) {
        members.emplace_back("joint", data_text(error.joint_key));
        members.emplace_back("joint_title", data_text(error.joint_title));
    }
    return data_object(members);
}

std::string point_data(const PagePoint& point) {
    std::vector<std::pair<std::string, std::string>> members;
    for (const auto& [name, text] : {std::pair("scene", &point.scene), std::pair("group", &point.group),
                                     std::pair("line", &point.line), std::pair("label", &point.label)})
        members.emplace_back(name, data_text(*text));
    for (const auto& [name, text] : {std::pair("light", &point.light), std::pair("kind", &point.kind),
                                     std::pair("command", &point.command), std::pair("mark", &point.mark)})
        if (!text->empty()) members.emplace_back(name, data_text(*text));
    for (const auto& [name, texts] : {std::pair("settings", &point.settings), std::pair("figures", &point.figures),
                                      std::pair("passes", &point.passes)})
        members.emplace_back(name, pairs(*texts));
    std::vector<std::pair<std::string, std::string>> numbers;
    for (const auto& [name, value] : point.numbers)
        if (std::isfinite(value)) numbers.emplace_back(name, data_number(value));
    members.emplace_back("numbers", data_object(numbers));
    if (!point.pictures.empty())
        members.emplace_back("pictures", list_of(point.pictures, [](const auto& one) {
                                 return data_list({std::to_string(one.first), data_text(one.second)});
                             }));
    return data_object(members);
}

} // namespace

std::string data_text(const std::string& text) {
    return json_dump(nlohmann::json(printable(text)));
}

std::string data_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : "null";
}

std::string data_list(const std::vector<std::string>& values) {
    return joined("[", values, "]");
}

std::string data_object(const std::vector<std::pair<std::string, std::string>>& members) {
    std::vector<std::string> values;
    for (const auto& [name, value] : members)
        values.push_back(data_text(name) + ":" + value);
    return joined("{", values, "}");
}

std::string page_chart_data(const PageChart& chart) {
    std::vector<std::pair<std::string, std::string>> members;
    for (const auto& [name, text] : {std::pair("scene_title", &chart.scene_title), std::pair("unset", &chart.unset),
                                     std::pair("error", &chart.error)})
        members.emplace_back(name, data_text(*text));
    members.emplace_back("costs", list_of(chart.costs, titled));
    members.emplace_back("errors", list_of(chart.errors, error_data));
    if (!chart.lights.empty()) members.emplace_back("lights", list_of(chart.lights, titled));
    if (!chart.kinds.empty()) members.emplace_back("kinds", list_of(chart.kinds, data_text));
    if (!chart.pictures.empty()) members.emplace_back("pictures", list_of(chart.pictures, data_text));
    members.emplace_back("points", list_of(chart.points, point_data));
    return data_object(members);
}

} // namespace bounce
