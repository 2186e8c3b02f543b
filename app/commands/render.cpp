// bounce render: a shot through a graph, to a file.
#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/session_options.h"
#include "app/hosts/headless.h"
#include "app/print.h"
#include "app/progress.h"
#include "app/timings.h"
#include "core/error.h"
#include "core/log.h"
#include "graph/shader_log.h"

#include <cstdio>
#include <fmt/format.h>
#include <thread>

namespace bounce {

namespace {

struct RenderArguments : SessionArguments {
    std::string output;
    std::string resource;
    std::string timings;
    int frames = 1;
    bool watch = false;
    bool quiet = false;
};

/// "x_%04d.png" → "x_0007.png"; empty when the name has no %0Nd.
std::string numbered(const std::string& pattern, int number) {
    size_t percent = pattern.find('%', pattern.rfind('/') + 1); // of the file, not of its folder
    if (percent == std::string::npos) return {};
    size_t end = pattern.find('d', percent);
    if (end == std::string::npos) throw Error("'" + pattern + "': frames are numbered as %04d");
    std::string digits = pattern.substr(percent + 1, end - percent - 1);
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 2) {
        throw Error("'" + pattern + "': frames are numbered as %04d");
    }
    int width = digits.empty() ? 0 : std::stoi(digits);
    return pattern.substr(0, percent) + fmt::format("{:0{}}", number, width) + pattern.substr(end + 1);
}

/// Throws when a shader does not compile: headless runs write nothing then.
void refuse_broken(const Session& session) {
    throw_if_broken(session, "nothing was written");
}

int render(const RenderArguments& arguments) {
    check_output_path(arguments.output);
    if (arguments.frames < 1 || arguments.frames > 1000000)
        throw Error(fmt::format("--frames {}: it is 1 … 1000000", arguments.frames));
    numbered(arguments.output, 0); // before anything is computed
    if (!arguments.timings.empty()) check_output_folder(arguments.timings);
    SessionOptions options = arguments.options();
    options.resource = arguments.resource;
    set_shader_errors_logged(arguments.watch);
    HeadlessContext context(arguments.device);
    spdlog::debug("{}", describe(context.capabilities()));
    Session session(options);
    if (!arguments.watch) refuse_broken(session);
    bool every_frame = !numbered(arguments.output, 0).empty();
    Progress progress("rendering");
    for (int frame = 0; frame < arguments.frames; ++frame) {
        if (arguments.watch) session.poll_files();
        if (frame > 0) session.advance();
        session.render(true);
        if (!arguments.watch) refuse_broken(session);
        if (every_frame) write_picture(session, numbered(arguments.output, frame), arguments.resource);
        progress.update(double(frame + 1) / arguments.frames);
    }
    if (arguments.watch) refuse_broken(session);
    if (!every_frame) write_picture(session, arguments.output, arguments.resource);
    session.graph().finish_timings();
    if (!arguments.timings.empty()) write_timings(session, arguments.timings);
    if (arguments.quiet) return 0;
    print("{}", timing_table(session));
    print("{}\n", every_frame ? fmt::format("{} … {}", numbered(arguments.output, 0),
                                            numbered(arguments.output, arguments.frames - 1))
                              : arguments.output);
    return 0;
}

} // namespace

void add_render_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("render", "render a shot to a file, without a window");
    auto arguments = std::make_shared<RenderArguments>();
    arguments->add_to(*command, true);
    command
        ->add_option("-o,--output", arguments->output,
                     "x.exr (linear parts), x.png (display); %04d numbers every frame")
        ->type_name("FILE")
        ->required();
    command->add_option("--frames", arguments->frames,
                        "render so many frames; the last is written, or all where the name holds %04d");
    command->add_option("--resource", arguments->resource, "write this one resource (gbuffer.normal …)");
    command->add_option("--timings", arguments->timings, "write GPU times and bytes per pass to this .json")
        ->type_name("FILE");
    command->add_flag("--watch", arguments->watch,
                      "reload graph and shaders between frames; errors keep the last good ones");
    command->add_flag("--quiet,-q", arguments->quiet, "print no table");
    command->callback([arguments, &chosen] { chosen = [arguments] { return render(*arguments); }; });
}

} // namespace bounce
