// bounce compare: how far one picture is from another, part by part.
#include "app/capture.h"
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/experiments/comparison_page.h"
#include "app/print.h"
#include "core/error.h"
#include "core/heat_map.h"

#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int k_max_window = 255;

struct CompareArguments {
    std::string image, reference, heatmap, page;
    std::vector<std::string> parts;
    float heatmap_top = 0.5f;
    double exposure = 0;
    bool exposure_given = false;
    bool json = false, no_mask = false, per_surface = false;
    float ppd = k_flip_pixels_per_degree;
    int window = 1;
};

int compare(const CompareArguments& arguments) {
    for (const std::string& output : {arguments.heatmap, arguments.page})
        if (!output.empty()) check_output_file(output);
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
    options.window = arguments.window;
    if (arguments.exposure_given) options.exposure = float(arguments.exposure);
    ComparisonReport report{arguments.image,
                            arguments.reference,
                            compare_layers(image, reference, options),
                            {},
                            pixels_a_side,
                            arguments.window,
                            image_place.outside,
                            reference_place.outside};
    const LayerComparison& comparison = report.comparison;
    if (arguments.per_surface) {
        for (const PartComparison& part : comparison.parts) {
            if (part.figures["mean"] == 0 && part.figures["reference_mean"] == 0) continue;
            const auto more = compare_surfaces(image, reference, part.part, comparison.mask);
            report.surfaces.insert(report.surfaces.end(), more.begin(), more.end());
        }
        if (report.surfaces.empty()) throw Error("--per-surface: neither file has gbuffer.normal and gbuffer.material");
    }
    // The figures first: a false-colour picture that cannot be written does not cost them.
    if (arguments.json)
        print("{}\n", comparison_json(report));
    else
        print("{}", comparison_text(report));
    if (arguments.heatmap.empty() && arguments.page.empty()) return 0;
    // The picture as a whole where there is one, unless a part was asked for.
    const PartComparison* chosen = &comparison.parts.front();
    for (const PartComparison& p : comparison.parts) {
        if (arguments.parts.empty() && p.part == "out.radiance") chosen = &p;
    }
    ComparedPictures pictures{chosen->part,
                              part_of(image, chosen->part, "the image"),
                              part_of(reference, chosen->part, "the reference"),
                              !image_display && is_radiance(chosen->part),
                              chosen->exposure,
                              arguments.heatmap_top};
    match_channels(pictures.image, pictures.reference);
    if (!arguments.heatmap.empty())
        write_png(arguments.heatmap, heat_map(relative_error_map(pictures.image, pictures.reference), 0,
                                              arguments.heatmap_top, comparison.mask));
    if (!arguments.page.empty()) write_file_atomically(arguments.page, comparison_html(report, pictures));
    return 0;
}

} // namespace

void add_compare_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("compare", "tell how far a picture is from a reference, part by part");
    auto a = std::make_shared<CompareArguments>();
    command
        ->add_option("image", a->image,
                     "an .exr of named parts, or any picture; a whole multiple of the reference's size is averaged")
        ->type_name("FILE")
        ->required();
    command->add_option("reference", a->reference, "what it is compared with")->type_name("FILE")->required();
    command
        ->add_option("--resource", a->parts,
                     "only this part, or sum of parts (out.emitted+out.indirect_diffuse); repeatable")
        ->check(not_empty())
        ->allow_extra_args(false);
    command->add_option("--heatmap", a->heatmap, "write the relative error in false colour to this .png")
        ->type_name("FILE")
        ->check(not_empty());
    command
        ->add_option("--heatmap-top", a->heatmap_top, "the error (of the reference's mean) that is brightest in maps")
        ->capture_default_str()
        ->check(number_between(1e-6, 1e6));
    command
        ->add_option("--html", a->page,
                     "write a page with both pictures under a divider, the error map and the figures")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_flag("--json", a->json, "print JSON");
    command->add_flag("--no-mask", a->no_mask, "count edge pixels too");
    command->add_flag("--per-surface", a->per_surface, "also by material and dominant normal axis");
    command->add_option("--window", a->window, "also compare means over N x N pixels inside the mask (N odd)")
        ->check(odd_between(1, k_max_window))
        ->capture_default_str();
    auto* exposure =
        command->add_option("--exposure", a->exposure, "stops, for SSIM and FLIP; else from the reference's mean")
            ->check(number_between(-64, 64));
    command->add_option("--ppd", a->ppd, "pixels per degree of the viewer, for FLIP")
        ->capture_default_str()
        ->check(number_between(1, 1000));
    command->callback([a, exposure, &chosen] {
        a->exposure_given = exposure->count() > 0;
        chosen = [a] { return compare(*a); };
    });
}

} // namespace bounce
