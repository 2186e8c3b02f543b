// bounce ablate: what each pass and each departure of a graph costs and buys on a shot, and the minimal graph.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/ablation_report.h"
#include "app/graph_preset.h"
#include "app/hosts/headless.h"
#include "app/print.h"
#include "core/error.h"
#include "graph/graph_file.h"

#include <fmt/format.h>

namespace bounce {

namespace {

struct AblateArguments {
    SessionArguments session;
    std::string against, output;
    int samples = 256, frames = 3, pairs_of = 4;
    double worth = 1;
    AblateArguments() { session.size = "128x72"; }
};

int run(const AblateArguments& arguments) {
    arguments.session.check_names();
    AblationSettings settings;
    settings.session = arguments.session.options();
    settings.published = arguments.against.empty() ? published_graph_of(arguments.session.graph) : arguments.against;
    if (!settings.published.empty()) find_graph(settings.published);
    settings.samples = arguments.samples;
    settings.frames = arguments.frames;
    settings.pairs_of = arguments.pairs_of;
    settings.worth = arguments.worth;
    const std::filesystem::path folder = arguments.output;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(fmt::format("cannot create the folder '{}': {}", arguments.output, error.message()));

    HeadlessContext context(arguments.session.device);
    VariantMeasurer measurer(settings.session, settings.samples, settings.frames);
    const Ablation ablation = ablate(measurer, settings, [](const std::string& line) {
        print("{}\n", line);
        std::fflush(stdout);
    });
    const Origin origin = origin_here();
    const std::string table = ablation_markdown(ablation, settings, origin);
    write_file_atomically(folder / "ablation.md", table);
    write_file_atomically(folder / "ablation.csv", ablation_csv(ablation));
    const std::filesystem::path minimal = folder / "minimal.json";
    const VariantFigures &before = ablation.whole, &after = ablation.minimal_figures;
    write_file_atomically(
        minimal, graph_preset_text(measurer.session(), minimal,
                                   fmt::format("What is worth its time on {}: {:.3g} of {:.3g} ms, error {:.2f} % "
                                               "where the whole graph has {:.2f} %.",
                                               settings.session.shot, after.ms, before.ms, 100 * after.error,
                                               100 * before.error)));
    write_file_atomically(folder / "ablation.html", ablation_html(ablation, settings, origin, measurer));
    print("{}/ablation.html\n", arguments.output);
    return 0;
}

} // namespace

void add_ablate_command(CLI::App& app, CommandFunction& chosen) {
    auto* command =
        app.add_subcommand("ablate", "what each pass and departure of a graph buys on a shot, and the minimal graph");
    auto a = std::make_shared<AblateArguments>();
    a->session.add_to(*command, true);
    command->add_option("--against", a->against, "departures are put back to this graph's values, not to its base's")
        ->type_name("GRAPH")
        ->check(not_empty());
    command->add_option("--spp", a->samples, "samples a pixel of the reference")
        ->check(whole_between(2, 1 << 20))
        ->capture_default_str();
    command->add_option("--frames", a->frames, "frames that are measured, of each")
        ->check(whole_between(1, 1000))
        ->capture_default_str();
    command->add_option("--pairs", a->pairs_of, "so many of the strongest are also left out in pairs")
        ->check(whole_between(0, 16))
        ->capture_default_str();
    command
        ->add_option("--worth", a->worth,
                     "% of the error that a part must take away for each % of the time that it takes")
        ->check(number_between(0, 100))
        ->capture_default_str();
    command->add_option("-o,--output", a->output, "the folder for ablation.md, .csv, .html and minimal.json")
        ->type_name("FILE")
        ->required();
    command->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace bounce
