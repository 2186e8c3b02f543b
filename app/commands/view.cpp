// bounce view: the window.
#include "app/commands/command.h"
#include "app/commands/session_options.h"
#include "app/viewer/viewer_app.h"
#include "core/error.h"
#include "core/scanner.h"

#include <fmt/format.h>

namespace bounce {

namespace {

struct ViewArguments : SessionArguments {
    ViewOptions view;
    std::string window;
};

glm::ivec2 window_size(const std::string& text) {
    auto read = scan_size(text, 3, 5);
    if (!read) throw Error(fmt::format("--window {}: it is written WxH, as 1366x768", shortened(text)));
    return {read->first, read->second};
}

int view(const ViewArguments& arguments) {
    ViewOptions options = arguments.view;
    options.session = arguments.options();
    options.session.rebuild = Rebuild::on_change;
    if (options.frames < 0 || options.frames > 1000000)
        throw Error(fmt::format("--frames {}: it is 1 … 1000000", options.frames));
    if (!arguments.window.empty()) options.window_size = window_size(arguments.window);
    ViewerApp(std::move(options)).run();
    return 0;
}

} // namespace

void add_view_command(CLI::App& app, CommandFunction& chosen) {
    auto* command =
        app.add_subcommand("view", "open the window (the shot and graph of the last time where none is given)");
    auto arguments = std::make_shared<ViewArguments>();
    arguments->add_to(*command, false);
    command->add_option("--window", arguments->window, "WxH of the window");
    command->add_option("--frames", arguments->view.frames, "quit after so many rendered frames");
    command
        ->add_option("--capture-on-exit", arguments->view.capture_on_exit,
                     "write the last picture to this .png or .exr")
        ->type_name("FILE");
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
