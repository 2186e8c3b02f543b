// bounce table: costs in the form of a paper's tables and beside its figures, errors against the reference, or limits.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/cost_table.h"
#include "app/experiments/error_table.h"
#include "app/experiments/paper_list.h"
#include "app/experiments/table_file.h"
#include "app/hosts/headless.h"
#include "app/origin.h"
#include "app/print.h"
#include "core/error.h"
#include "core/image.h"
#include "core/limits.h"
#include "gpu/shader_limits.h"
#include "gpu/timer.h"

#include <fmt/format.h>

namespace bounce {

namespace {
struct TableArguments {
    std::string table, size, output;
    int warm_up = 2, frames = 5, seconds = 0, device = -1;
};

std::string measured_errors(const TableArguments& arguments, const std::filesystem::path& path) {
    if (!arguments.size.empty())
        throw Error("invalid --size '" + arguments.size + "': a table of errors states its sizes itself");
    const ErrorTableFile file = load_error_table(path);
    HeadlessContext context(arguments.device);
    std::vector<ErrorTableMeasured> measured;
    for (const ErrorTableRow& row : file.rows) {
        print_error("{}, {} …\n", row.graph, row.name);
        try {
            measured.push_back(measure_row(row, [](const std::string& line) { print_error("  {}\n", line); }));
        } catch (const Error& error) {
            // What other rows measured is not lost by it.
            print_error("  not measured: {}\n", error.what());
            measured.emplace_back().skipped = error.what();
        }
    }
    const std::string about = file.about.empty() ? "" : file.about + "\n\n";
    return origin_head({origin_here()}) + "\n" + about + error_table_markdown(file, measured);
}

std::string measured_costs(const TableArguments& arguments) {
    CostTableFile file = load_cost_table(arguments.table);
    SessionArguments shared;
    shared.size = arguments.size;
    std::optional<glm::ivec2> size = shared.options().size;
    HeadlessContext context(arguments.device);
    std::vector<CostTableMeasured> measured;
    const double start = steady_seconds();
    std::string left_out;
    for (const CostTableColumn& column : file.columns) {
        if (arguments.seconds > 0 && !measured.empty() && steady_seconds() - start > arguments.seconds) {
            left_out += (left_out.empty() ? "" : "; ") + column.name;
            continue;
        }
        print_error("{} …\n", column.name);
        measured.push_back(measure_column(file, column, size, arguments.warm_up, arguments.frames));
    }
    file.columns.resize(measured.size());
    if (!left_out.empty()) left_out = fmt::format("\nLeft out after {} s: {}.\n", arguments.seconds, left_out);
    return origin_head({origin_here()}) + "\n" + cost_table_markdown(file, measured) + left_out;
}

/// What nothing has to be measured for.
std::string limits_table() {
    std::string out = origin_head({origin_here()}) + "\nWhat is read and made at most, and what happens beyond.\n\n" +
                      limits_markdown();
    out += "\nWhat the text of a shader may hold; beyond, the shader has an error, and no driver sees it.\n\n"
           "| what | at most | option |\n| --- | --- | --- |\n";
    for (const ShaderLimitEntry& entry : shader_limit_entries())
        out += fmt::format("| {} | {} | `--shader-limit {}=N` |\n", entry.help,
                           grouped(uint64_t(ShaderLimits().*entry.value)), entry.name);
    return out;
}

std::string table_text(const TableArguments& arguments) {
    if (arguments.table == "limits") return limits_table();
    if (arguments.table == "papers")
        return origin_head({origin_here()}) + "\n" + paper_list_markdown(load_paper_list(paper_list_path()));
    const std::filesystem::path path = find_table(arguments.table);
    return is_error_table(path) ? measured_errors(arguments, path) : measured_costs(arguments);
}

int print_table(const TableArguments& arguments) {
    if (!arguments.output.empty()) check_output_file(arguments.output);
    const std::string text = table_text(arguments);
    if (arguments.output.empty())
        print("{}", text);
    else
        write_file_atomically(arguments.output, text);
    return 0;
}
} // namespace

void add_table_command(CLI::App& app, CommandFunction& chosen) {
    auto* command =
        app.add_subcommand("table", "costs beside a paper's, errors against the reference, or lists, as Markdown");
    auto arguments = std::make_shared<TableArguments>();
    command->add_option("table", arguments->table, "a table (name or .json), limits, or papers: what we have of theirs")
        ->type_name("TABLE")
        ->required();
    command->add_option("--size", arguments->size, "WxH instead of the shots' sizes")->check(picture_size());
    command->add_option("--warmup", arguments->warm_up, "frames before measuring")
        ->check(whole_between(0, 1000))
        ->capture_default_str();
    command->add_option("--frames", arguments->frames, "frames that are measured")
        ->check(whole_between(1, 10000))
        ->capture_default_str();
    command->add_option("--seconds", arguments->seconds, "begin no further column of a table of costs after so long")
        ->check(whole_between(1, 100000));
    command->add_option("-o,--output", arguments->output, "write to this .md instead of the terminal")
        ->type_name("FILE")
        ->check(not_empty());
    add_device_option(*command, arguments->device);
    command->callback([arguments, &chosen] { chosen = [arguments] { return print_table(*arguments); }; });
}

} // namespace bounce
