#include "app/experiments/stability_report.h"

#include "app/experiments/csv.h"
#include "app/experiments/html_page.h"
#include "app/experiments/page_data.h"
#include "app/experiments/svg_scatter.h"
#include "app/experiments/table_file.h"
#include "core/error.h"
#include "core/image.h"
#include "core/printable.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::ordered_json;

namespace {

/// All graphs, in the order in which they first come.
std::vector<std::string> graphs_of(const std::vector<StabilityRow>& rows) {
    std::vector<std::string> graphs;
    for (const StabilityRow& row : rows)
        for (const StabilityCell& cell : row.cells)
            if (std::find(graphs.begin(), graphs.end(), cell.graph) == graphs.end()) graphs.push_back(cell.graph);
    return graphs;
}

const StabilityCell* cell_of(const StabilityRow& row, const std::string& graph) {
    const auto found = std::find_if(row.cells.begin(), row.cells.end(),
                                    [&](const StabilityCell& cell) { return cell.graph == graph; });
    return found == row.cells.end() ? nullptr : &*found;
}

std::string mark_text(const StabilityCase& which) {
    std::string text = stability_text(which, which.most, true);
    if (!text.empty() && text[0] == '+') text.erase(0, 1);
    return "≤ " + text;
}

/// "worst share", "last over first error".
std::string quantity_text(const StabilityCase& which) {
    if (which.ladder.size() == 1) return name_of(which.quantity);
    const std::string summary = which.summary == StabilitySummary::growth ? "last over first" : name_of(which.summary);
    return summary + " " + name_of(which.quantity);
}

/// The curve over the rungs, from 0 (or the least value below it) to the largest, and the mark as a dashed line.
std::string curve_svg(const StabilityCase& which, const StabilityCell& cell) {
    constexpr double width = 140, height = 44, pad = 4;
    if (cell.curve.size() < 2) return "";
    const bool marked = which.summary != StabilitySummary::growth;
    double low = 0, high = marked ? which.most : 0;
    for (double value : cell.curve)
        low = std::min(low, value), high = std::max(high, value);
    if (!(high > low) || !std::isfinite(high - low)) return "";
    const auto y = [&](double value) { return height - pad - (value - low) / (high - low) * (height - 2 * pad); };
    std::string line, title;
    for (size_t i = 0; i < cell.curve.size(); ++i) {
        const double x = pad + (width - 2 * pad) * double(i) / double(cell.curve.size() - 1);
        line += fmt::format("{:.1f},{:.1f} ", x, y(cell.curve[i]));
        title += fmt::format("{} {}: {}\n", which.step, which.ladder[i], stability_text(which, cell.curve[i], false));
    }
    std::string out =
        fmt::format("<svg class=\"curve\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\"><title>{2}</title>",
                    width, height, escape_markup(title));
    if (marked)
        out += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#999\" "
                           "stroke-dasharray=\"3 3\"/>",
                           pad, width - pad, y(which.most));
    return out + fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/></svg>", line,
                             cell.reached ? "#0072b2" : "#d55e00");
}

} // namespace

std::string cell_text(const StabilityCase& which, const StabilityCell& cell) {
    if (!cell.figure) return "–";
    return stability_text(which, *cell.figure, true) + (cell.reached ? " ✓" : " ✗");
}

std::string stability_markdown(const std::vector<StabilityRow>& rows, const Origin& origin) {
    const std::vector<std::string> graphs = graphs_of(rows);
    std::string out = origin_head({origin}) + "\n| case | figure | mark |", rule = "| --- | --- | --- |";
    for (const std::string& graph : graphs) {
        out += " " + markdown_cell(graph) + " |";
        rule += " ---: |";
    }
    out += "\n" + rule + "\n";
    std::string abouts, failures;
    for (const StabilityRow& row : rows) {
        out += fmt::format("| {} | {} | {} |", markdown_cell(row.which.name), quantity_text(row.which),
                           mark_text(row.which));
        for (const std::string& graph : graphs) {
            const StabilityCell* cell = cell_of(row, graph);
            out += " " + (cell ? cell_text(row.which, *cell) : std::string()) + " |";
            if (cell && !cell->failure.empty())
                failures += fmt::format("- {}, {}: {}\n", markdown_cell(row.which.name), markdown_cell(graph),
                                        markdown_cell(cell->failure));
        }
        out += "\n";
        std::string rungs;
        for (double value : row.which.ladder)
            rungs += fmt::format("{}{}", rungs.empty() ? "" : ", ", value);
        abouts += fmt::format("- **{}** ({} {}): {}\n", markdown_cell(row.which.name), rungs,
                              markdown_cell(row.which.unit.empty() ? row.which.step : row.which.unit),
                              markdown_cell(row.which.about));
    }
    out += "\n" + abouts;
    if (!failures.empty()) out += "\nNot measured:\n\n" + failures;
    return out;
}

std::string stability_csv(const std::vector<StabilityRow>& rows) {
    std::string out = "case,graph,quantity,summary,mark,figure,reached,step,rung,value,seconds,failure\n";
    for (const StabilityRow& row : rows)
        for (const StabilityCell& cell : row.cells)
            for (size_t i = 0; i < std::max<size_t>(cell.curve.size(), 1); ++i) {
                const bool measured = i < cell.curve.size();
                std::vector<std::string> fields = {csv_field(row.which.name),
                                                   csv_field(cell.graph),
                                                   name_of(row.which.quantity),
                                                   name_of(row.which.summary),
                                                   fmt::format("{:.6g}", row.which.most),
                                                   cell.figure ? fmt::format("{:.6g}", *cell.figure) : "",
                                                   cell.reached ? "1" : "0",
                                                   csv_field(row.which.step),
                                                   measured ? fmt::format("{:.6g}", row.which.ladder[i]) : "",
                                                   measured ? fmt::format("{:.6g}", cell.curve[i]) : "",
                                                   fmt::format("{:.3g}", cell.seconds),
                                                   csv_field(cell.failure)};
                out += join(fields, ",") + "\n";
            }
    return out;
}

std::string stability_json(const std::vector<StabilityRow>& rows, const Origin& origin) {
    ordered_json out = {{"commit", origin.commit}, {"machine", origin.machine}, {"renderer", origin.renderer},
                        {"driver", origin.driver}, {"date", origin.date},       {"cases", ordered_json::array()}};
    for (const StabilityRow& row : rows) {
        ordered_json one = {{"case", row.which.name},
                            {"about", row.which.about},
                            {"quantity", name_of(row.which.quantity)},
                            {"summary", name_of(row.which.summary)},
                            {"most", row.which.most},
                            {"step", row.which.step},
                            {"ladder", row.which.ladder},
                            {"graphs", ordered_json::object()}};
        for (const StabilityCell& cell : row.cells) {
            ordered_json measured = {
                {"key", cell.key}, {"curve", cell.curve}, {"reached", cell.reached}, {"seconds", cell.seconds}};
            if (cell.figure) measured["figure"] = *cell.figure;
            if (!cell.failure.empty()) measured["failure"] = printable(cell.failure);
            one["graphs"][cell.graph] = measured;
        }
        out["cases"].push_back(one);
    }
    return out.dump(1) + "\n";
}

std::vector<StabilityRow> read_stability(const std::filesystem::path& folder) {
    std::vector<StabilityRow> rows;
    const std::filesystem::path path = folder / "stability.json";
    if (!std::filesystem::exists(path)) return rows;
    const ordered_json read = read_table(path);
    try {
        for (const ordered_json& one : read.at("cases")) {
            StabilityRow row;
            row.which.name = one.at("case").get<std::string>();
            for (const auto& [graph, measured] : one.at("graphs").items()) {
                if (measured.contains("failure")) continue; // it may work now
                StabilityCell cell;
                cell.graph = graph;
                cell.key = measured.value("key", "");
                cell.curve = measured.at("curve").get<std::vector<double>>();
                cell.figure = measured.at("figure").get<double>();
                cell.reached = measured.at("reached").get<bool>();
                cell.seconds = measured.at("seconds").get<double>();
                row.cells.push_back(std::move(cell));
            }
            rows.push_back(std::move(row));
        }
    } catch (const ordered_json::exception& error) {
        throw Error(path.string() + ": not what stability writes: " + error.what());
    }
    return rows;
}

/// What the script draws large.
static std::string page_case(const StabilityRow& row) {
    const StabilityCase& which = row.which;
    const auto numbers = [](const std::vector<double>& values) {
        std::vector<std::string> list;
        for (double value : values)
            list.push_back(data_number(value));
        return data_list(list);
    };
    std::vector<std::string> curves;
    for (const StabilityCell& cell : row.cells) {
        if (cell.curve.empty()) continue;
        std::vector<std::string> texts;
        for (double value : cell.curve)
            texts.push_back(data_text(stability_text(which, value, false)));
        curves.push_back(data_object({{"graph", data_text(cell.graph)},
                                      {"values", numbers(cell.curve)},
                                      {"texts", data_list(texts)},
                                      {"reached", cell.reached ? "true" : "false"}}));
    }
    const bool marked = which.summary != StabilitySummary::growth;
    return data_object({{"name", data_text(which.name)},
                        {"quantity", data_text(quantity_text(which))},
                        {"mark", marked ? data_number(which.most) : "null"},
                        {"mark_text", data_text(mark_text(which))},
                        {"step", data_text(which.unit.empty() ? which.step : which.unit)},
                        {"ladder", numbers(which.ladder)},
                        {"curves", data_list(curves)}});
}

/// Cells of different cases are told apart by how often the mark goes into them.
static std::string sorted_by(const StabilityRow& row, const StabilityCell& cell) {
    if (!cell.figure || !(row.which.most > 0)) return "";
    return fmt::format(" data-sort=\"{:.6g}\"", std::abs(*cell.figure) / row.which.most);
}

std::string stability_html(const std::vector<StabilityRow>& rows, const Origin& origin) {
    const std::vector<std::string> graphs = graphs_of(rows);
    std::string body =
        "<h1>Stability</h1>\n<p class=\"origin\">" + escape_markup(origin_head({origin})) +
        "</p>\n<p>Each row is a way in which methods fail. Curves go over the case's ladder; the dashed line is the "
        "mark. "
        "Point at a curve for its values; with script it is then seen large, a click keeps it, and a click on a head "
        "sorts by how often the mark goes into the figure.</p>\n<table class=\"sortable wide\"><tr><th>case</th>"
        "<th class=\"plain\">mark</th>";
    std::vector<std::string> names, cases;
    for (const std::string& graph : graphs) {
        body += "<th>" + escape_markup(graph) + "</th>";
        names.push_back(data_text(graph));
    }
    body += "</tr>\n";
    for (const StabilityRow& row : rows) {
        body += fmt::format("<tr data-case=\"{}\"><td><b "
                            "class=\"name\">{}</b><br><small>{}</small></td><td>{}<br><small>{}</small></td>",
                            cases.size(), escape_markup(row.which.name), escape_markup(row.which.about),
                            escape_markup(mark_text(row.which)), escape_markup(quantity_text(row.which)));
        cases.push_back(page_case(row));
        for (size_t i = 0; i < graphs.size(); ++i) {
            const StabilityCell* cell = cell_of(row, graphs[i]);
            if (!cell)
                body += "<td></td>";
            else if (!cell->failure.empty())
                body += fmt::format("<td data-sort=\"\"><small>{}</small></td>", escape_markup(cell->failure));
            else
                body += fmt::format("<td class=\"{}\" data-graph=\"{}\"{}>{}{}</td>",
                                    cell->reached ? "reached" : "missed", i, sorted_by(row, *cell),
                                    escape_markup(cell_text(row.which, *cell)), curve_svg(row.which, *cell));
        }
        body += "</tr>\n";
    }
    return html_page({"stability",
                      body + "</table>\n",
                      data_object({{"graphs", data_list(names)}, {"cases", data_list(cases)}}),
                      {"stability"}});
}

void write_stability(const std::vector<StabilityRow>& rows, const Origin& origin, const std::filesystem::path& folder) {
    write_file_atomically(folder / "stability.csv", stability_csv(rows));
    write_file_atomically(folder / "stability.json", stability_json(rows, origin));
    write_file_atomically(folder / "stability.html", stability_html(rows, origin));
    write_file_atomically(folder / "stability.md", stability_markdown(rows, origin));
}

} // namespace bounce
