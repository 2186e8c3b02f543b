// bounce: subcommands, nothing else.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/commands/usage_error.h"
#include "app/hosts/headless.h"
#include "app/origin.h"
#include "app/print.h"
#include "core/error.h"
#include "core/limits.h"
#include "core/log.h"
#include "gpu/call_watch.h"

#include <fmt/format.h>
#include <new>

int main(int argc, char** argv) {
    using namespace bounce;
    prepare_streams();
    CLI::App app("Bounce: a research sandbox for real-time global illumination");
    app.set_version_flag("--version", std::string("bounce ") + program_commit());
    bool verbose = false, list_devices = false;
    app.add_flag("--verbose,-v", verbose, "show debug messages");
    app.add_flag("--list-devices", list_devices, "list the EGL devices for --device");
    std::string max_texture;
    app.add_option("--max-texture", max_texture, "WxH: pixels of a scene's textures in all (16384x16384)")
        ->check(texture_pixels());
    app.require_subcommand(0, 1);
    app.fallthrough();
    CommandFunction chosen;
    set_command_line(argc, argv);
    add_view_command(app, chosen);
    add_render_command(app, chosen);
    add_graph_command(app, chosen);
    add_params_command(app, chosen);
    add_info_command(app, chosen);
    add_new_command(app, chosen);
    add_shaders_command(app, chosen);
    add_reference_command(app, chosen);
    add_compare_command(app, chosen);
    add_chart_command(app, chosen);
    add_table_command(app, chosen);
    add_ablate_command(app, chosen);
    add_stability_command(app, chosen);
    add_tune_command(app, chosen);
    add_list_command(app, chosen);
    add_completion_command(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::CallForAllHelp& help) {
        return app.exit(help);
    } catch (const CLI::CallForVersion& version) {
        return app.exit(version);
    } catch (const CLI::ParseError& error) {
        print_error("error: {}\n", usage_error(app, error, argc, argv));
        return 2;
    }
    if (!max_texture.empty()) set_max_texture_pixels(parse_texture_pixels(max_texture));
    start_log(verbose);
    try {
        if (list_devices) {
            for (const HeadlessDevice& device : list_headless_devices())
                print("{}: {}\n", device.index, device.name);
            return 0;
        }
        const int code = chosen ? chosen() : run_default();
        // What is printed may be the result (--json): a full disk behind it is an error as behind any other file.
        if (const std::string problem = output_problem(); !problem.empty())
            throw Error("cannot write to standard output: " + problem);
        if (calls_are_watched()) spdlog::info("{}", hazard_check().barrier_report());
        if (calls_are_watched() && !hazard_check().hazards().empty())
            throw Error(fmt::format("{} hazards were found", hazard_check().hazards().size()));
        return code;
    } catch (const std::bad_alloc&) {
        print_error(
            "error: out of memory: expected a smaller scene, --size or graph (`bounce graph` tells its bytes)\n");
    } catch (const std::exception& error) {
        print_error("error: {}\n", error.what());
    }
    (void)output_problem(); // what was told before the error is shown, too
    return 2;
}
