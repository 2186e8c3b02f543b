// bounce graph: prints a graph's plan.
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/graph_difference.h"
#include "app/graph_svg.h"
#include "app/print.h"
#include "core/error.h"
#include "core/image.h"
#include "graph/plan_needs.h"
#include "scene/find_scene.h"

#include <fmt/format.h>

namespace bounce {

namespace {
struct GraphArguments {
    std::string name;
    std::string shot = k_default_shot;
    std::vector<std::string> sets;
    std::string size;
    std::string limits;
    bool graphviz = false;
    bool svg = false;
    std::string output;
    bool expanded = false;
    std::string diff;
};

OrderedJson whole_graph(const std::string& name) {
    return in_file_order(expand_graph(find_graph(name)).root);
}

/// The overlay that makes `to` of `from`.
std::string departures_text(const std::string& from, const std::string& to) {
    const std::string text = graph_difference(from, whole_graph(from), whole_graph(to));
    return text.empty() ? graph_text({{"version", 1}, {"extends", from}}) : text;
}

int print_graph(const GraphArguments& arguments) {
    if (arguments.expanded || !arguments.diff.empty()) {
        for (const std::string& name : {arguments.name, arguments.diff})
            if (!name.empty()) GraphModel(read_graph_file(find_graph(name))); // what is wrong with it is reported
        print("{}", arguments.diff.empty() ? graph_text(whole_graph(arguments.name))
                                           : departures_text(arguments.name, arguments.diff));
        return 0;
    }
    find_graph(arguments.name);
    find_shot(arguments.shot);
    SessionArguments shared;
    shared.sets = arguments.sets;
    shared.size = arguments.size;
    shared.limits = arguments.limits;
    SessionOptions options = shared.options();
    GraphModel model(read_graph_file(find_graph(arguments.name)));
    for (const auto& [name, text] : options.sets)
        model.set(name, text, ParameterOrigin::command_line);
    Shot shot = load_shot(arguments.shot);
    const SceneFacts facts = shot_facts(shot);
    const Plan plan = model.plan(facts, options.size.value_or(glm::ivec2(shot.width, shot.height)));
    check_plan_limits(model, facts, plan); // pretended ones: there is no driver here
    if (arguments.svg && !arguments.output.empty())
        write_file_atomically(arguments.output, graph_svg(model, plan, facts));
    else if (arguments.svg)
        print("{}", graph_svg(model, plan, facts));
    else if (arguments.graphviz)
        print("{}", plan_graphviz(model, plan));
    else
        print("{}\nneeds, and what every driver of OpenGL 4.6 has:\n{}", plan_text(model, plan),
              needs_text(plan_needs(model, plan)));
    return 0;
}
} // namespace

void add_graph_command(CLI::App& app, CommandFunction& chosen) {
    auto* command =
        app.add_subcommand("graph", "print a graph's plan: passes in order, reads and writes, bytes, what is skipped");
    auto arguments = std::make_shared<GraphArguments>();
    command->add_option("graph", arguments->name, "a graph: name or .json")->type_name("GRAPH")->required();
    command->add_option("--shot", arguments->shot, "the shot that it is planned for")
        ->type_name("SHOT")
        ->capture_default_str();
    command->add_option("--set", arguments->sets, "a parameter: pass.name=value")->allow_extra_args(false);
    command->add_option("--size", arguments->size, "WxH instead of the shot's size")->check(picture_size());
    SessionArguments::add_limits_to(*command, arguments->limits);
    auto* graphviz = command->add_flag("--graphviz", arguments->graphviz, "as a Graphviz digraph (dot -Tsvg)");
    auto* svg = command->add_flag("--svg", arguments->svg, "as a picture of boxes and wires")->excludes(graphviz);
    command->add_option("-o,--output", arguments->output, "the .svg to write instead of printing it")
        ->type_name("FILE")
        ->needs(svg);
    auto* expanded =
        command->add_flag("--expanded", arguments->expanded, "as one graph file that extends nothing")->excludes(svg);
    command
        ->add_option("--diff", arguments->diff,
                     "as what another graph departs from it in: a graph file that extends it")
        ->excludes(expanded)
        ->excludes(svg);
    command->callback([arguments, &chosen] { chosen = [arguments] { return print_graph(*arguments); }; });
}

} // namespace bounce
