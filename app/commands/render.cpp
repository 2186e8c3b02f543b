// bounce render: a shot through a graph, to a file.
#include "app/broken_shaders.h"
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/session_options.h"
#include "app/experiments/error_over_frames.h"
#include "app/film.h"
#include "app/hosts/headless.h"
#include "app/print.h"
#include "app/progress.h"
#include "app/timings.h"
#include "core/error.h"
#include "core/limits.h"
#include "core/log.h"
#include "core/memory.h"
#include "graph/shader_log.h"

#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <thread>

namespace bounce {

namespace {

struct RenderArguments : SessionArguments {
    std::string output;
    std::string resource;
    std::string timings;
    std::string reference;
    int frames = 1;
    bool watch = false;
    bool quiet = false;
};

/// "x_%04d.png" → "x_0007.png"; empty when the name has no %0Nd. A % in a folder's name numbers nothing.
std::string numbered(const std::string& pattern, int number) {
    const size_t percent = pattern.find('%', pattern.rfind('/') + 1);
    if (percent == std::string::npos) return {};
    // "%d", or "%0" and one digit, once.
    const std::string rest = pattern.substr(percent + 1);
    int width = 0;
    size_t length = 0;
    if (rest.starts_with("d")) {
        length = 1;
    } else if (rest.size() >= 3 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9' && rest[2] == 'd') {
        width = rest[1] - '0';
        length = 3;
    }
    if (length == 0 || rest.find('%', length) != std::string::npos)
        throw Error(
            fmt::format("invalid output name '{}': expected %d or %04d once, for the number of the frame, or no "
                        "% at all",
                        pattern));
    return pattern.substr(0, percent) + fmt::format("{:0{}}", number, width) + rest.substr(length);
}

/// What can be told of the output before anything is computed.
void check_output(const RenderArguments& arguments) {
    if (arguments.output.empty()) throw Error("invalid --output '': expected a file, as x.exr or x.png");
    if (!arguments.timings.empty()) check_output_file(arguments.timings);
    if (is_film(arguments.output)) return check_film_path(arguments.output);
    const std::string extension = std::filesystem::path(arguments.output).extension().string();
    if (extension != ".exr" && extension != ".png")
        throw Error(fmt::format("invalid output name '{}': expected one that ends in .exr or .png, or, for a film, in "
                                ".mp4 or .webm",
                                arguments.output));
    const bool every_frame = !numbered(arguments.output, 0).empty();
    for (int frame : {0, arguments.frames - 1})
        check_output_path(every_frame ? numbered(arguments.output, frame) : arguments.output);
}

/// While a film is written, Ctrl+C ends it between two frames, so that no half of it is left.
class InterruptWatch {
  public:
    InterruptWatch() {
        for (int signal : {SIGINT, SIGTERM})
            std::signal(signal, [](int) { asked_to_end_ = 1; });
    }
    ~InterruptWatch() {
        for (int signal : {SIGINT, SIGTERM})
            std::signal(signal, SIG_DFL);
    }
    static void check() {
        if (asked_to_end_) throw Error("interrupted: no film was written");
    }

  private:
    static inline volatile std::sig_atomic_t asked_to_end_ = 0;
};

/// Headless runs write nothing when a shader does not compile.
void refuse_broken(const Session& session) {
    throw_if_broken(session, "nothing was written");
}

int render(const RenderArguments& arguments) {
    arguments.check_names();
    SessionOptions options = arguments.options();
    check_output(arguments);
    options.resource = arguments.resource;
    std::optional<ErrorOverFrames> errors;
    if (!arguments.reference.empty()) errors.emplace(arguments.reference, arguments.resource);
    set_shader_errors_logged(arguments.watch);
    HeadlessContext context(arguments.device);
    spdlog::debug("{}", describe(context.capabilities()));
    Session session(options);
    if (!arguments.watch) refuse_broken(session);
    const bool film_wanted = is_film(arguments.output);
    require_memory(picture_bytes(session, film_wanted ? "frame.png" : arguments.output, arguments.resource),
                   fmt::format("the picture '{}' of {}x{}", arguments.output, session.size().x, session.size().y),
                   "lower --size, or write one part with --resource");
    const bool every_frame = !film_wanted && !numbered(arguments.output, 0).empty();
    std::optional<Film> film;
    std::optional<InterruptWatch> interrupts;
    if (film_wanted) {
        interrupts.emplace();
        check_film_path(arguments.output);
    }
    Progress progress("rendering");
    for (int frame = 0; frame < arguments.frames; ++frame) {
        if (arguments.watch) session.poll_files();
        if (frame > 0) session.advance();
        session.render(true);
        if (!arguments.watch) refuse_broken(session);
        if (every_frame) write_picture(session, numbered(arguments.output, frame), arguments.resource);
        if (film_wanted) {
            const Image8 picture = display_picture(session, arguments.resource);
            // A texture may have a size of its own.
            if (!film) film.emplace(arguments.output, glm::ivec2(picture.width, picture.height), session.shot().fps);
            film->add(picture);
            interrupts->check();
        }
        if (errors) errors->add(session, frame + 1, frame + 1 == arguments.frames);
        progress.update(double(frame + 1) / arguments.frames);
    }
    if (arguments.watch) refuse_broken(session);
    if (film)
        film->finish();
    else if (!every_frame)
        write_picture(session, arguments.output, arguments.resource);
    session.graph().finish_timings();
    if (!arguments.timings.empty()) write_timings(session, arguments.timings);
    if (arguments.quiet) return 0;
    print("{}", timing_table(session));
    if (errors) print("{}", errors->text());
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
                     "x.exr (linear parts), x.png (display), x_%04d.png, x.mp4 or x.webm (all frames)")
        ->type_name("FILE");
    command
        ->add_option("--frames", arguments->frames,
                     "render so many frames; the last is written, or all as a film or with %04d")
        ->check(whole_between(1, k_max_frames));
    command->add_option("--resource", arguments->resource, "write this one resource (gbuffer.normal …)")
        ->check(not_empty());
    command
        ->add_option("--reference", arguments->reference,
                     "an .exr to compare with after 1, 4, 16, 64 … frames and the last")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_option("--timings", arguments->timings, "write GPU times and bytes per pass to this .json")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_flag("--watch", arguments->watch,
                      "reload graph and shaders between frames; errors keep the last good ones");
    command->add_flag("--quiet,-q", arguments->quiet, "print no table");
    command->callback([arguments, &chosen] { chosen = [arguments] { return render(*arguments); }; });
}

} // namespace bounce
