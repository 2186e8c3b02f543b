// bounce reference: the path-traced truth of a shot, to a file.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/experiments/transport.h"
#include "app/print.h"
#include "app/progress.h"
#include "core/error.h"
#include "core/exr_file.h"
#include "core/limits.h"
#include "core/text.h"
#include "reference/reference_image.h"
#include "scene/describe.h"
#include "scene/find_scene.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace bounce {

namespace {

struct ReferenceArguments {
    std::string shot, output, resource, size, material_model;
    std::string bounces = "unlimited", occlusion_falloff = "none";
    int samples = 0, frame = 0;
    double noise = 0;
    float exposure = 0;
    bool no_cache = false, quiet = false;
    ReferenceSettings settings;
};

std::atomic<bool> interrupted{false};

/// While it lives, Ctrl-C (and a scheduler's request to end) asks for a stop; a second one ends the program at once.
class InterruptGuard {
  public:
    InterruptGuard() {
        interrupted = false;
        struct sigaction action {};
        action.sa_handler = [](int) { interrupted = true; };
        action.sa_flags = int(SA_RESETHAND);
        sigaction(SIGINT, &action, &old_interrupt_);
        sigaction(SIGTERM, &action, &old_terminate_);
    }
    ~InterruptGuard() {
        sigaction(SIGINT, &old_interrupt_, nullptr);
        sigaction(SIGTERM, &old_terminate_, nullptr);
    }

  private:
    struct sigaction old_interrupt_ {
    }, old_terminate_{};
};

/// "unlimited", or a whole number up to 9999.
CLI::Validator bounces() {
    const CLI::Validator number = whole_between(0, 9999);
    return CLI::Validator(
        [number](std::string& text) {
            if (text == "unlimited" || number(text).empty()) return std::string();
            return fmt::format("'{}': expected a whole number from 0 (direct light only) to 9999, or 'unlimited'",
                               text);
        },
        "");
}

int parse_bounces(const std::string& text) {
    return text == "unlimited" ? k_unlimited_bounces : std::stoi(text);
}

std::string add_metadata(const std::string& made, const ReferenceArguments& arguments, const ReferenceResult& result) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(made);
    json["commit"] = program_commit();
    json["shot_file"] = arguments.shot;
    json["frame"] = arguments.frame;
    json["complete"] = result.complete;
    if (!arguments.resource.empty()) json["resource"] = arguments.resource;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// As the graphs' tone map does by default (no curve), so that both programs' pictures can be laid side by side.
Image8 to_display(const Image& image, float exposure) {
    const float scale = std::exp2(exposure);
    Image8 out{image.width, image.height, std::vector<uint8_t>(size_t(image.width) * size_t(image.height) * 4, 255)};
    for (size_t i = 0; i < size_t(image.width) * size_t(image.height); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float value = image.pixels[i * size_t(image.channels) + size_t(std::min(c, image.channels - 1))];
            out.rgba[4 * i + size_t(c)] = uint8_t(std::lround(255 * srgb_encode(value * scale)));
        }
    }
    return out;
}

void write_reference(const ReferenceArguments& arguments, const ReferenceResult& result) {
    const std::filesystem::path path = arguments.output;
    if (path.extension() == ".png") {
        const bool picture = arguments.resource.empty();
        const Image& image = result.image.layers.at(picture ? "out.radiance" : arguments.resource);
        write_png(path, to_display(image, picture ? arguments.exposure : 0));
        return;
    }
    LayeredImage file;
    if (arguments.resource.empty())
        file = result.image;
    else
        file.layers[arguments.resource] = result.image.layers.at(arguments.resource);
    file.metadata = add_metadata(result.image.metadata, arguments, result);
    write_exr(path, file, arguments.resource.empty() ? "out.radiance" : arguments.resource);
}

/// Writes the reference. When that fails, what was computed must not be lost with it: the samples are in the cache, or
/// else the whole picture goes to the folder for temporary files. The error says which.
void write_or_save(const ReferenceArguments& arguments, const ReferenceResult& result) {
    try {
        write_reference(arguments, result);
    } catch (const Error& error) {
        if (!arguments.no_cache && result.kept_problem.empty()) {
            throw Error(std::string(error.what()) + "; the samples are kept: the same command goes on from them");
        }
        // A folder of its own: in a shared one somebody else may have put a link of that name.
        std::string folder = (std::filesystem::temp_directory_path() / "bounce-reference-XXXXXX").string();
        if (!::mkdtemp(folder.data())) throw;
        const std::filesystem::path refuge = std::filesystem::path(folder) / "reference.exr";
        LayeredImage file = result.image;
        file.metadata = add_metadata(result.image.metadata, arguments, result);
        try {
            write_exr(refuge, file, "out.radiance");
        } catch (const Error& second) {
            throw Error(fmt::format("{}; nor could it be saved elsewhere: {}", error.what(), second.what()));
        }
        throw Error(fmt::format("{}; all parts are saved in '{}'", error.what(), refuge.string()));
    }
}

/// What is written besides the parts; such a resource has no noise of its own to go by.
const std::vector<std::string> k_surface_layers{"gbuffer.normal",   "gbuffer.position",  "gbuffer.albedo",
                                                "gbuffer.material", "gbuffer.roughness", "gbuffer.metallic"};

bool is_surface_layer(const std::string& name) {
    return std::find(k_surface_layers.begin(), k_surface_layers.end(), name) != k_surface_layers.end();
}

void check_resource(const std::string& resource) {
    std::vector<std::string> names{"out.radiance"};
    for (const ReferencePart& part : k_reference_parts)
        names.emplace_back(part.name);
    names.insert(names.end(), k_surface_layers.begin(), k_surface_layers.end());
    if (resource.empty() || std::find(names.begin(), names.end(), resource) != names.end()) return;
    throw Error("the reference makes no '" + resource + "'" + did_you_mean(resource, names));
}

int reference(ReferenceArguments arguments) {
    find_shot(arguments.shot);
    check_resource(arguments.resource);
    if (arguments.output.empty()) throw Error("invalid --output '': expected a file, as x.exr or x.png");
    check_output_path(arguments.output);
    arguments.settings.bounces = parse_bounces(arguments.bounces);
    arguments.settings.occlusion_falloff = occlusion_falloff(arguments.occlusion_falloff);
    Shot shot = load_shot(arguments.shot);
    if (!arguments.size.empty()) {
        const glm::ivec2 size = parse_size(arguments.size);
        shot.width = size.x;
        shot.height = size.y;
    }
    // Lengths that are shares of the diagonal leave strays out: say so, as the other commands do.
    if (const std::string strays = describe_strays(shot_facts(shot)); !strays.empty()) spdlog::warn("{}", strays);
    if (!arguments.material_model.empty()) shot.material_model = material_model_named(arguments.material_model);

    ReferenceGoal goal;
    goal.samples = arguments.samples;
    goal.noise = arguments.noise;
    if (goal.samples == 0 && goal.noise == 0) goal.noise = 0.01;
    if (!arguments.resource.empty() && !is_surface_layer(arguments.resource)) goal.part = arguments.resource;

    const auto start = std::chrono::steady_clock::now();
    auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    ReferenceResult result;
    {
        InterruptGuard guard;
        Progress bar("path tracing");
        auto on_progress = [&](const ReferenceProgress& progress) {
            // The bar tells the time left from the share: give it the share that says what is known.
            const double passed = elapsed();
            if (progress.seconds_left >= 0) bar.update(passed / std::max(1e-9, passed + progress.seconds_left));
            return !interrupted;
        };
        result = reference_image(shot, arguments.settings, arguments.frame, goal, on_progress, !arguments.no_cache);
    }
    if (!result.kept_problem.empty()) {
        print_error("warning: the samples could not be kept for a later run: {}\n", result.kept_problem);
    }
    if (result.complete || result.samples >= 1) write_or_save(arguments, result);
    if (!arguments.quiet || !result.complete) {
        print("{}: {} samples a pixel, noise {:.2f} % of {}{}\n", arguments.output, result.samples, 100 * result.noise,
              goal.part,
              result.cached             ? " (from the cache)"
              : result.resumed_from > 0 ? fmt::format(" (resumed from {} samples)", result.resumed_from)
                                        : "");
    }
    if (!result.complete) {
        print_error("stopped before the goal; {}\n", arguments.no_cache || !result.kept_problem.empty()
                                                         ? "nothing was kept for a later run"
                                                         : "the same command goes on from here");
        return interrupted ? 130 : 1;
    }
    if (goal.noise > 0 && result.noise > goal.noise) {
        print_error("warning: the noise is still above {} after {} samples\n", goal.noise, result.samples);
    }
    return 0;
}

} // namespace

void add_reference_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("reference", "path-trace a shot: the truth that methods are compared with");
    auto a = std::make_shared<ReferenceArguments>();
    command->add_option("shot", a->shot, "a shot (name or .json), or a scene (.gltf, .glb)")
        ->type_name("SHOT")
        ->required();
    command->add_option("-o,--output", a->output, "x.exr (every part as a layer) or x.png (required)")
        ->type_name("FILE");
    command->add_option("--bounces", a->bounces, "scattering orders after direct light: 0, 1, … or 'unlimited'")
        ->check(bounces())
        ->capture_default_str();
    auto* samples = command->add_option("--spp", a->samples, "samples a pixel")->check(whole_between(2, 1 << 20));
    command->add_option("--noise", a->noise, "stop at this relative noise (0.01 when neither is given)")
        ->check(number_between(1e-6, 10.0))
        ->excludes(samples);
    command->add_flag("--diffuse-only", a->settings.diffuse_only,
                      "leave out the microfacet lobe: Lambert, if the model is plain");
    command->add_flag("--diffuse-secondary", a->settings.diffuse_secondary,
                      "leave out the microfacet lobe behind the visible surface");
    add_material_model_option(*command, a->material_model);
    command
        ->add_option("--resource", a->resource,
                     "write this one part (out.indirect_diffuse …); --noise then means its noise")
        ->check(not_empty());
    command->add_option("--size", a->size, "WxH instead of the shot's size")->check(picture_size());
    command->add_option("--frame", a->frame, "frame of an animated shot")->check(whole_between(0, k_max_frames));
    command
        ->add_option("--occlusion-distance", a->settings.occlusion_distance,
                     "d_max of out.ambient_occlusion_dmax, as a share of the scene's diagonal")
        ->capture_default_str()
        ->check(number_between(1e-6, 1e6));
    command
        ->add_option("--occlusion-falloff", a->occlusion_falloff,
                     "within d_max an occluder at d counts fully (none) or by 1 - (d/d_max)^2 (quadratic)")
        ->check(one_of({k_occlusion_falloffs.begin(), k_occlusion_falloffs.end()}))
        ->capture_default_str();
    command->add_option("--exposure", a->exposure, "stops, for a .png of the whole picture")
        ->check(number_between(-64, 64))
        ->capture_default_str();
    command->add_option("--seed", a->settings.seed, "another seed is an independent image")
        ->check(whole_between(0, 4294967295))
        ->capture_default_str();
    command->add_option("--threads", a->settings.threads, "0 = all")->check(whole_between(0, 4096));
    command->add_flag("--no-cache", a->no_cache, "neither take from nor add to the cache of earlier runs");
    command->add_flag("--quiet,-q", a->quiet, "print nothing when all goes well");
    command->callback([a, &chosen] { chosen = [a] { return reference(*a); }; });
}

} // namespace bounce
