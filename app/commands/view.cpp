// bounce view: the window.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/viewer/viewer_app.h"
#include "core/error.h"
#include "core/limits.h"
#include "graph/graph_file.h"
#include "scene/find_scene.h"

#include <fmt/format.h>

namespace bounce {

namespace {

struct ViewArguments : SessionArguments {
    ViewOptions view;
    std::string window;
};

int view(const ViewArguments& arguments) {
    ViewOptions options = arguments.view;
    options.session = arguments.options();
    options.session.rebuild = Rebuild::on_change;
    if (options.shot_given) find_shot(arguments.shot);
    if (options.graph_given) find_graph(arguments.graph);
    if (!options.capture_on_exit.empty()) check_output_path(options.capture_on_exit);
    if (!arguments.window.empty()) options.window_size = parse_size(arguments.window);
    ViewerApp(std::move(options)).run();
    return 0;
}

} // namespace

void add_view_command(CLI::App& app, CommandFunction& chosen) {
    auto* command =
        app.add_subcommand("view", "open the window (the shot and graph of the last time where none is given)");
    auto arguments = std::make_shared<ViewArguments>();
    arguments->add_to(*command, false);
    command->add_option("--window", arguments->window, "WxH of the window")->check(window_size());
    command->add_option("--frames", arguments->view.frames, "quit after so many rendered frames")
        ->check(whole_between(1, k_max_frames));
    command
        ->add_option("--capture-on-exit", arguments->view.capture_on_exit,
                     "write the last picture to this .png or .exr")
        ->type_name("FILE")
        ->check(not_empty());
    // For tests of the window.
    command->add_option("--dump-ui", arguments->view.dump_ui, "tell each drawn frame to this .json")->group("");
    command->add_option("--simulate-reset", arguments->view.simulate_reset, "lose the GPU after so many frames")
        ->group("");
    command->callback([arguments, command, &chosen] {
        arguments->view.shot_given = command->count("shot") > 0;
        arguments->view.graph_given = command->count("--graph") > 0;
        chosen = [arguments] { return view(*arguments); };
    });
}

int view_default() {
    ViewArguments arguments;
    arguments.graph = k_first_graph;
    return view(arguments);
}

} // namespace bounce
