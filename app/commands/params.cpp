// bounce params: every parameter of a graph (or of all graphs), as text or Markdown.
#include "app/commands/command.h"
#include "app/print.h"
#include "core/asset_files.h"
#include "core/error.h"
#include "core/printable.h"
#include "graph/model.h"

#include <fmt/format.h>

namespace bounce {

namespace {
struct ParamsArguments {
    std::string graph;
    bool markdown = false;
};

void print_set(const std::string& id, const ParameterSet& set, bool markdown) {
    for (const Parameter& p : set.all()) {
        std::string name = id + "." + p.info.name, value = p.text(), range = range_text(p.info);
        std::string unit = p.info.unit.empty() ? "" : " " + p.info.unit;
        std::string help =
            p.info.help + (p.info.is_static ? " (compiled in)" : "") +
            (p.info.automatic.empty() ? "" : fmt::format(" (auto: by the need for {})", p.info.automatic));
        if (markdown)
            print("| `{}` | {} | {}{} | {} |\n", name, markdown_cell(value), markdown_cell(range), markdown_cell(unit),
                  markdown_cell(help));
        else
            print("  {:<32} {:<12} {:<24} {}\n", name, value, range + unit, help);
    }
}

void print_graph_parameters(const std::filesystem::path& path, bool markdown) {
    GraphModel model(read_graph_file(path));
    if (markdown)
        print("\n### {}\n\n{}\n\n| parameter | value | range, unit | what it is |\n| --- | --- | --- | --- |\n",
              model.file().name, model.file().about);
    else
        print("{}: {}\n", model.file().name, model.file().about);
    print_set("graph", model.graph_parameters(), markdown);
    for (const auto& node : model.nodes())
        print_set(node->id(), node->parameters, markdown);
}

int print_params(const ParamsArguments& arguments) {
    if (!arguments.graph.empty()) {
        print_graph_parameters(find_graph(arguments.graph), arguments.markdown);
        return 0;
    }
    for (const std::string& graph : asset_names("graphs"))
        print_graph_parameters(find_graph(graph), arguments.markdown);
    return 0;
}
} // namespace

void add_params_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("params", "list the parameters of a graph, or of all graphs");
    auto arguments = std::make_shared<ParamsArguments>();
    command->add_option("graph", arguments->graph, "a graph: name or .json")->type_name("GRAPH");
    command->add_flag("--markdown", arguments->markdown, "as Markdown tables");
    command->callback([arguments, &chosen] { chosen = [arguments] { return print_params(*arguments); }; });
}

} // namespace bounce
