// bounce stability: the suite of cases in which methods fail, or how steady one shot is while its lights or objects
// move.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/flicker.h"
#include "app/experiments/stability_report.h"
#include "app/hosts/headless.h"
#include "app/print.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/text.h"
#include "graph/shader_log.h"

#include <fmt/format.h>

namespace bounce {

namespace {
struct StabilityArguments {
    SessionArguments session;
    std::string resource = "out.indirect_diffuse", graphs, cases;
    int frames = 24;
    float fps = 0;
    std::string output;
    bool resume = false;
};

/// As a table under the head of all results.
std::string flicker_markdown(const StabilityArguments& arguments, const Session& session,
                             const FlickerFigures& figures) {
    return origin_head({origin_here()}) +
           fmt::format(
               "\n| picture | shot | graph | frames | mean | change | flicker | 99th percentile | FLIP over time |\n"
               "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n"
               "| {} | {} | {} | {} | {:.5g} | {:.3f} % | {:.3f} % | {:.3f} % | {:.4f} |\n",
               markdown_cell(arguments.resource), markdown_cell(session.shot().name),
               markdown_cell(session.graph().model().file().name), figures.frames, figures.mean, 100 * figures.change,
               100 * figures.flicker, 100 * figures.flicker_p99, figures.flip);
}

int print_flicker(const StabilityArguments& arguments) {
    if (arguments.resume) throw Error("invalid --resume: expected cases, not a shot");
    if (!arguments.graphs.empty() || !arguments.cases.empty())
        throw Error("invalid stability: expected either a shot with --graph, or --graphs and --cases without a shot");
    arguments.session.check_names();
    if (!arguments.output.empty()) check_output_file(arguments.output);
    const SessionOptions options = arguments.session.options();
    set_shader_errors_logged(false);
    HeadlessContext context(arguments.session.device);
    Session session(options);
    if (arguments.fps > 0) session.shot().fps = arguments.fps;
    FlickerFigures figures = measure_flicker(session, arguments.resource, arguments.frames);
    print("{} of {} through {}, {} frames: mean {:.5g}, change {:.3f} %, flicker {:.3f} %, 99th percentile {:.3f} "
          "%, FLIP over time {:.4f}\n",
          arguments.resource, session.shot().name, session.graph().model().file().name, figures.frames, figures.mean,
          100 * figures.change, 100 * figures.flicker, 100 * figures.flicker_p99, figures.flip);
    if (!arguments.output.empty())
        write_file_atomically(arguments.output, flicker_markdown(arguments, session, figures));
    return 0;
}

/// Every case with every graph. The files are written after each cell, so that what was measured is kept.
int print_suite(const StabilityArguments& arguments) {
    if (arguments.resume && arguments.output.empty()) throw Error("invalid --resume: expected a folder, -o DIR");
    const std::vector<std::string> graphs =
        split(arguments.graphs.empty() ? arguments.session.graph : arguments.graphs, ',');
    for (const std::string& graph : graphs)
        find_graph(graph);
    std::vector<StabilityCase> cases;
    ErrorList errors;
    for (const std::string& name : arguments.cases.empty() ? stability_case_names() : split(arguments.cases, ',')) {
        try {
            cases.push_back(load_stability_case(name));
        } catch (const Error& error) {
            errors.add(error.what());
        }
    }
    errors.throw_if_any("stability");
    if (!arguments.output.empty()) {
        std::error_code error;
        std::filesystem::create_directories(arguments.output, error);
        if (error) throw Error(fmt::format("cannot create the folder '{}': {}", arguments.output, error.message()));
    }
    StabilitySuite suite{std::move(cases), graphs, {}, {}};
    const SessionOptions options = arguments.session.options();
    suite.own.sets.insert(options.sets.begin(), options.sets.end());
    suite.own.switches.insert(options.switches.begin(), options.switches.end());
    if (arguments.resume) suite.known = read_stability(arguments.output);
    HeadlessContext context(arguments.session.device);
    const Origin origin = origin_here();
    run_stability(suite, [&](const std::vector<StabilityRow>& rows, bool known) {
        const StabilityRow& row = rows.back();
        const StabilityCell& cell = row.cells.back();
        print("{}, {}: {}{}\n", row.which.name, cell.graph,
              cell.failure.empty() ? cell_text(row.which, cell) : "not measured: " + cell.failure,
              known ? " (measured before)" : "");
        std::fflush(stdout);
        if (!arguments.output.empty()) write_stability(rows, origin, arguments.output);
    });
    if (!arguments.output.empty()) print("{}/stability.html\n", arguments.output);
    return 0;
}
} // namespace

void add_stability_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand(
        "stability", "cases in which methods fail, or a shot's flicker while its lights or objects move");
    auto a = std::make_shared<StabilityArguments>();
    a->session.shot.clear();
    a->session.add_to(*command, false);
    command->add_option("--graphs", a->graphs, "without a shot: graphs for the cases, separated by commas")
        ->type_name("GRAPHS")
        ->check(not_empty());
    command->add_option("--cases", a->cases, "without a shot: these alone, separated by commas (bounce list cases)")
        ->type_name("CASES")
        ->check(not_empty());
    command->add_option("--resource", a->resource, "of a shot: which picture")
        ->check(not_empty())
        ->capture_default_str();
    command->add_option("--frames", a->frames, "of a shot: frames to render")
        ->check(whole_between(3, 100000))
        ->capture_default_str();
    command->add_option("--fps", a->fps, "of a shot: frames a second instead of its own: more make smaller steps")
        ->check(number_between(0.001, 100000));
    command->add_option("-o,--output", a->output, "write to this .md, or of cases to this folder")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_flag("--resume", a->resume,
                      "of cases: keeps what the folder of -o holds of this very program, case and graph");
    command->callback(
        [a, &chosen] { chosen = [a] { return a->session.shot.empty() ? print_suite(*a) : print_flicker(*a); }; });
}

} // namespace bounce
