// bounce stability: how steady a picture is while the lights or objects of a shot move in small steps.
#include "app/experiments/stability.h"
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/hosts/headless.h"
#include "app/origin.h"
#include "app/print.h"
#include "core/error.h"
#include "core/printable.h"
#include "graph/shader_log.h"

#include <fmt/format.h>

namespace bounce {

namespace {
struct StabilityArguments {
    SessionArguments session;
    std::string resource = "out.indirect_diffuse";
    int frames = 24;
    float fps = 0;
    std::string output;
};

/// As a table under the head of all results.
std::string stability_markdown(const StabilityArguments& arguments, const Session& session,
                               const StabilityFigures& figures) {
    return origin_head({origin_here()}) +
           fmt::format("\n| picture | shot | graph | frames | mean | change | flicker | 99th percentile |\n"
                       "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |\n"
                       "| {} | {} | {} | {} | {:.5g} | {:.3f} % | {:.3f} % | {:.3f} % |\n",
                       markdown_cell(arguments.resource), markdown_cell(session.shot().name),
                       markdown_cell(session.graph().model().file().name), figures.frames, figures.mean,
                       100 * figures.change, 100 * figures.flicker, 100 * figures.flicker_p99);
}

int print_stability(const StabilityArguments& arguments) {
    arguments.session.check_names();
    if (!arguments.output.empty()) check_output_file(arguments.output);
    const SessionOptions options = arguments.session.options();
    set_shader_errors_logged(false);
    HeadlessContext context(arguments.session.device);
    Session session(options);
    if (arguments.fps > 0) session.shot().fps = arguments.fps;
    StabilityFigures figures = measure_stability(session, arguments.resource, arguments.frames);
    print("{} of {} through {}, {} frames: mean {:.5g}, change {:.3f} %, flicker {:.3f} %, 99th percentile {:.3f} "
          "%\n",
          arguments.resource, session.shot().name, session.graph().model().file().name, figures.frames, figures.mean,
          100 * figures.change, 100 * figures.flicker, 100 * figures.flicker_p99);
    if (!arguments.output.empty())
        write_file_atomically(arguments.output, stability_markdown(arguments, session, figures));
    return 0;
}
} // namespace

void add_stability_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("stability", "flicker of a picture while a shot's lights or objects move");
    auto a = std::make_shared<StabilityArguments>();
    a->session.add_to(*command, true);
    command->add_option("--resource", a->resource, "which picture")->check(not_empty())->capture_default_str();
    command->add_option("--frames", a->frames, "frames to render")
        ->check(whole_between(3, 100000))
        ->capture_default_str();
    command->add_option("--fps", a->fps, "frames a second instead of the shot's: more make smaller steps")
        ->check(number_between(0.001, 100000));
    command->add_option("-o,--output", a->output, "also write the figures to this .md")
        ->type_name("FILE")
        ->check(not_empty());
    command->callback([a, &chosen] { chosen = [a] { return print_stability(*a); }; });
}

} // namespace bounce
