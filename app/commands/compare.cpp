// bounce compare: how far one picture is from another, part by part.
#include "app/capture.h"
#include "app/commands/command.h"
#include "core/comparison.h"
#include "core/error.h"
#include "core/heat_map.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bounce {

namespace {

struct CompareArguments {
    std::string image, reference, heatmap;
    std::vector<std::string> parts;
    float heatmap_top = 0.5f;
    double exposure = 0;
    bool exposure_given = false;
    bool json = false, no_mask = false, per_surface = false;
    float ppd = k_flip_pixels_per_degree;
};

nlohmann::ordered_json figures_json(const ErrorFigures& f) {
    // JSON has no infinity: where the reference is black, relative figures are null.
    return {{"pixels", f.pixels},
            {"mean", f.mean},
            {"reference_mean", f.reference_mean},
            {"bias", f.bias},
            {"mean_difference", f.mean_difference()},
            {"rmse", f.rmse},
            {"rmse_denoised", f.rmse_denoised()},
            {"relative_rmse", f.relative_rmse},
            {"relative_rmse_denoised", f.relative_rmse_denoised},
            {"reference_noise", f.reference_noise},
            {"relative_mse", f.relative_mse},
            {"smape", f.smape},
            {"relative_error_p99", f.relative_error_p99},
            {"largest_error", f.largest_error}};
}

std::string comparison_json(const CompareArguments& arguments, const LayerComparison& comparison,
                            const std::vector<SurfaceComparison>& surfaces, int pixels_a_side, double image_outside,
                            double reference_outside) {
    nlohmann::ordered_json json;
    json["image"] = arguments.image;
    json["reference"] = arguments.reference;
    json["means_over_pixels"] = pixels_a_side * pixels_a_side;
    json["outside_data_window"] = image_outside;
    json["reference_outside_data_window"] = reference_outside;
    json["edges_masked"] = comparison.edges_masked;
    json["kept_pixels"] = comparison.mask.share();
    for (const PartComparison& part : comparison.parts) {
        nlohmann::ordered_json entry = figures_json(part.figures);
        entry["own_noise"] = part.own_noise;
        entry["ssim"] = part.ssim;
        entry["flip"] = part.flip;
        entry["exposure"] = part.exposure;
        json["parts"][part.part] = entry;
    }
    for (const SurfaceComparison& surface : surfaces) {
        nlohmann::ordered_json entry = {{"part", surface.part}, {"material", surface.material}, {"axis", surface.axis}};
        entry.update(figures_json(surface.figures));
        json["surfaces"].push_back(entry);
    }
    return json.dump(2);
}

void print_table(const LayerComparison& comparison, const std::vector<SurfaceComparison>& surfaces, int pixels_a_side) {
    fmt::print("{:28} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>7} {:>7}\n", "part", "mean",
               "reference", "bias %", "RMSE %", "noise %", "w/o noise", "relMSE", "SMAPE", "p99", "SSIM", "FLIP");
    auto row = [](const std::string& name, const ErrorFigures& f) {
        return fmt::format("{:28} {:10.5g} {:10.5g} {:+9.2f} {:9.2f} {:9.2f} {:9.2f} {:8.4f} {:8.4f} {:8.4f}", name,
                           f.mean, f.reference_mean, 100 * f.bias, 100 * f.relative_rmse, 100 * f.reference_noise,
                           100 * f.relative_rmse_denoised, f.relative_mse, f.smape, f.relative_error_p99);
    };
    for (const PartComparison& part : comparison.parts) {
        fmt::print("{} {:7.4f} {:7.4f}\n", row(part.part.empty() ? "(picture)" : part.part, part.figures), part.ssim,
                   part.flip);
        if (part.part.find("ambient_occlusion") != std::string::npos) {
            fmt::print("  in AO units: bias {:+.4f}, RMSE {:.4f}, without the reference's noise {:.4f}\n",
                       part.figures.mean_difference(), part.figures.rmse, part.figures.rmse_denoised());
        }
    }
    for (const SurfaceComparison& surface : surfaces) {
        fmt::print("{}\n",
                   row(fmt::format("  material {} facing {}", surface.material, surface.axis), surface.figures));
    }
    fmt::print("{} of the pixels count{}. RMSE and noise are relative to the reference's mean.\n",
               fmt::format("{:.1f} %", 100 * comparison.mask.share()),
               comparison.edges_masked ? ", away from edges" : "; no edge mask");
    if (pixels_a_side > 1)
        fmt::print(
            "The image is {0} times as wide and high as the reference: compared are means over {0} x {0} pixels.\n",
            pixels_a_side);
}

int compare(const CompareArguments& arguments) {
    if (!arguments.heatmap.empty()) check_output_folder(arguments.heatmap);
    bool image_display = false, reference_display = false;
    PicturePlace image_place, reference_place;
    LayeredImage image = read_picture(arguments.image, image_display, &image_place);
    const LayeredImage reference = read_picture(arguments.reference, reference_display, &reference_place);
    int pixels_a_side = 1;
    image = averaged_to_size_of(reference, std::move(image), &pixels_a_side);
    if (image_place.x != pixels_a_side * reference_place.x || image_place.y != pixels_a_side * reference_place.y) {
        throw Error(fmt::format("'{}' begins at pixel ({}, {}) and '{}' at ({}, {}): expected the same display window",
                                arguments.image, image_place.x, image_place.y, arguments.reference, reference_place.x,
                                reference_place.y));
    }
    if (image_display != reference_display) {
        throw Error("'" + arguments.image + "' and '" + arguments.reference +
                    "': one holds display values and the other linear radiance; compare two of a kind");
    }
    ComparisonOptions options;
    options.parts = arguments.parts;
    options.mask_edges = !arguments.no_mask;
    options.display_values = image_display;
    options.ppd = arguments.ppd;
    if (arguments.exposure_given) options.exposure = float(arguments.exposure);
    const LayerComparison comparison = compare_layers(image, reference, options);

    std::vector<SurfaceComparison> surfaces;
    if (arguments.per_surface) {
        for (const PartComparison& part : comparison.parts) {
            if (part.figures.mean == 0 && part.figures.reference_mean == 0) continue;
            const auto more = compare_surfaces(image, reference, part.part, comparison.mask);
            surfaces.insert(surfaces.end(), more.begin(), more.end());
        }
        if (surfaces.empty()) throw Error("--per-surface: neither file has gbuffer.normal and gbuffer.material");
    }
    // The figures first: a false-colour picture that cannot be written does not cost them.
    if (arguments.json)
        fmt::print("{}\n", comparison_json(arguments, comparison, surfaces, pixels_a_side, image_place.outside,
                                           reference_place.outside));
    else
        print_table(comparison, surfaces, pixels_a_side);
    for (const auto& [name, place] :
         {std::pair(arguments.image, image_place), std::pair(arguments.reference, reference_place)}) {
        if (place.outside > 0 && !arguments.json)
            fmt::print("{:.1f} % of '{}' lies outside of its data window and counts as black.\n", 100 * place.outside,
                       name);
    }
    if (!arguments.heatmap.empty()) {
        // The picture as a whole where there is one, unless a part was asked for.
        std::string part = comparison.parts.front().part;
        for (const PartComparison& p : comparison.parts) {
            if (arguments.parts.empty() && p.part == "out.radiance") part = p.part;
        }
        Image a = part_of(image, part, "the image"), b = part_of(reference, part, "the reference");
        match_channels(a, b);
        const Image errors = relative_error_map(a, b);
        write_png(arguments.heatmap, heat_map(errors, 0, arguments.heatmap_top, comparison.mask));
    }
    return 0;
}

} // namespace

void add_compare_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("compare", "tell how far a picture is from a reference, part by part");
    auto a = std::make_shared<CompareArguments>();
    command
        ->add_option("image", a->image,
                     "an .exr of named parts, or any picture; a whole multiple of the reference's size is averaged")
        ->required();
    command->add_option("reference", a->reference, "what it is compared with")->required();
    command
        ->add_option("--resource", a->parts,
                     "only this part, or sum of parts (out.emitted+out.indirect_diffuse); repeatable")
        ->allow_extra_args(false);
    command->add_option("--heatmap", a->heatmap, "write the relative error in false colour to this .png");
    command->add_option("--heatmap-top", a->heatmap_top, "the error (of the reference's mean) that is brightest there")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command->add_flag("--json", a->json, "print JSON");
    command->add_flag("--no-mask", a->no_mask, "count edge pixels too");
    command->add_flag("--per-surface", a->per_surface, "also by material and dominant normal axis");
    auto* exposure =
        command->add_option("--exposure", a->exposure, "stops, for SSIM and FLIP; else from the reference's mean");
    command->add_option("--ppd", a->ppd, "pixels per degree of the viewer, for FLIP")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 1000.0));
    command->callback([a, exposure, &chosen] {
        a->exposure_given = exposure->count() > 0;
        chosen = [a] { return compare(*a); };
    });
}

} // namespace bounce
