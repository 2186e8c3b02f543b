// bounce tune: settings of a graph for an error, a time or a memory, as a graph that extends it.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/tune_page.h"
#include "app/graph_preset.h"
#include "app/hosts/headless.h"
#include "app/origin.h"
#include "app/print.h"
#include "core/error.h"
#include "core/text.h"
#include "graph/graph_file.h"
#include "scene/find_scene.h"
#include "scene/shot.h"

#include <fmt/format.h>

namespace bounce {

namespace {

struct TuneArguments {
    SessionArguments session;
    std::vector<std::string> shots;
    double error = 0, time = 0, memory = 0, minutes = 20;
    std::string over, output;
    double first_share = 0.5;
    int tries = 200, samples = 256, frames = 2;
    TuneArguments() { session.size = "128x72"; }
};

int run(const TuneArguments& arguments) {
    for (const std::string& shot : arguments.shots)
        load_shot(shot); // a wrong one is told before anything is computed
    const std::filesystem::path preset = graph_preset_path(arguments.output);
    find_graph(arguments.session.graph);
    TuneSettings settings;
    settings.shots = arguments.shots;
    settings.session = arguments.session.options();
    if (arguments.error > 0) settings.goal.error = arguments.error / 100;
    if (arguments.time > 0) settings.goal.ms = arguments.time;
    if (arguments.memory > 0) settings.goal.bytes = arguments.memory * 1048576;
    if (!arguments.over.empty()) settings.over = split(arguments.over, ',');
    settings.budget = arguments.tries;
    settings.seconds = 60 * arguments.minutes;
    settings.samples = arguments.samples;
    settings.frames = arguments.frames;
    settings.first_scale = arguments.first_share;
    check_output_file(preset);

    HeadlessContext context(arguments.session.device);
    const auto say = [](const std::string& line) {
        print("{}\n", line);
        std::fflush(stdout);
    };
    TuneMemory memory(std::filesystem::path(preset).replace_extension(".points.json"), tune_key(settings));
    if (memory.size() > 0) say(fmt::format("{} points were measured before", memory.size()));
    const TuneOutcome outcome = tune(settings, memory, say);
    const TunePoint& start = outcome.finals.front();
    const TunePoint& found = outcome.finals.size() > 1 ? outcome.finals[1] : start;
    write_file_atomically(std::filesystem::path(preset).replace_extension(".md"),
                          origin_head({origin_here()}) + "\n" + tune_markdown(settings, outcome));
    SessionOptions own = settings.session;
    own.shot = settings.shots.front();
    Session session(own);
    set_parameters(session.graph().model(), found.variant.sets);
    const std::string about =
        fmt::format("Found by tune on {}: {:.3g} ms and {:.2f} % of error, where {} has {:.3g} ms and {:.2f} %.",
                    join(settings.shots, ", "), found.figures.ms, 100 * found.figures.error, settings.session.graph,
                    start.figures.ms, 100 * start.figures.error);
    write_file_atomically(preset, graph_preset_text(session, preset, about));
    write_file_atomically(std::filesystem::path(preset).replace_extension(".html"),
                          tune_html(settings, outcome, origin_here()));
    print("{}\n{}\n", about, preset.string());
    const bool missed = (settings.goal.error && found.figures.error > *settings.goal.error) ||
                        (settings.goal.ms && found.figures.ms > *settings.goal.ms) ||
                        (settings.goal.bytes && found.figures.bytes > *settings.goal.bytes);
    if (missed) print("What was asked for was not reached.\n");
    return 0;
}

} // namespace

void add_tune_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("tune", "search a graph's settings for an error, a time or a memory on shots");
    auto a = std::make_shared<TuneArguments>();
    command->add_option("shots", a->shots, "shots or scenes: their geometric mean counts")
        ->type_name("SHOT")
        ->required();
    command->add_option("--graph,-g", a->session.graph, "the graph to start from: name or .json")
        ->type_name("GRAPH")
        ->check(not_empty())
        ->capture_default_str();
    a->session.add_settings_to(*command);
    command->add_option("--error", a->error, "% of relative RMSE that is to be reached; default: the graph's own")
        ->check(number_between(1e-4, 1e6));
    command->add_option("--time", a->time, "ms a frame that are not to be exceeded")->check(number_between(1e-4, 1e9));
    command->add_option("--memory", a->memory, "MiB that are not to be exceeded")->check(number_between(1e-3, 1e9));
    command->add_option("--over", a->over, "search these parameters alone: gather.*,voxelization.resolution")
        ->check(not_empty());
    command->add_option("--budget", a->minutes, "minutes after which no further variant is begun")
        ->check(number_between(0.01, 1e5))
        ->capture_default_str();
    command->add_option("--tries", a->tries, "variants at most")
        ->check(whole_between(1, 1000000))
        ->capture_default_str();
    command->add_option("--spp", a->samples, "samples a pixel of the references")
        ->check(whole_between(2, 1 << 20))
        ->capture_default_str();
    command->add_option("--frames", a->frames, "frames that are measured, of each")
        ->check(whole_between(1, 1000))
        ->capture_default_str();
    command->add_option("--first-size", a->first_share, "width and height of the search's pictures, share of --size")
        ->check(number_between(0.01, 1))
        ->capture_default_str();
    command
        ->add_option("-o,--output", a->output,
                     "the preset (name or .json); beside it .md, .html and .points.json, from which a run goes on")
        ->type_name("FILE")
        ->required();
    command->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace bounce
