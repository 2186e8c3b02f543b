#include "core/comparison.h"

#include "core/error.h"
#include "core/image_exr.h"
#include "core/json_text.h"
#include "core/text.h"
#include "core/window_mean.h"

#include <algorithm>

namespace bounce {

static std::vector<std::string> summands(const std::string& part) {
    return part.empty() ? std::vector<std::string>{""} : split(part, '+');
}

/// "ViewLayer.Combined", "View Layer.Combined.left", "beauty", "rgba": what Blender, Nuke and others call it.
static bool names_the_picture(const std::string& layer) {
    for (std::string part : split(layer, '.')) {
        std::transform(part.begin(), part.end(), part.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        for (const char* known : {"combined", "beauty", "rgba", "rgb", "color", "colour", "image"})
            if (part == known) return true;
    }
    return false;
}

/// The layer that is the picture as a whole; null when there is none, or it cannot be told which.
static const std::string* picture_layer(const LayeredImage& image) {
    if (auto unnamed = image.layers.find(""); unnamed != image.layers.end()) return &unnamed->first;
    for (const auto& [name, layer] : image.layers)
        if (names_the_picture(name)) return &name;
    bool own = !image.layers.empty() &&
               (image.layers.begin()->first.starts_with("out.") || image.layers.begin()->first.starts_with("gbuffer."));
    return image.layers.size() == 1 && !own ? &image.layers.begin()->first : nullptr;
}

Image part_of(const LayeredImage& image, const std::string& part, const std::string& what) {
    Image sum;
    const std::string* whole = picture_layer(image);
    for (const std::string& name : summands(part)) {
        auto layer = image.layers.find(name.empty() && whole ? *whole : name);
        if (layer == image.layers.end()) continue;
        if (sum.empty()) {
            sum = layer->second;
            continue;
        }
        check_same_size(sum, what + ", " + part, layer->second, what + ", " + name);
        for (size_t i = 0; i < sum.pixels.size(); ++i)
            sum.pixels[i] += layer->second.pixels[i];
    }
    if (sum.empty()) {
        std::vector<std::string> names;
        for (const auto& [name, layer] : image.layers)
            names.push_back(name);
        throw Error(what + " has no part '" + part + "'" + did_you_mean(part, names));
    }
    return sum;
}

Image part_or_black(const LayeredImage& image, const std::string& part, const Image& like) {
    const std::vector<std::string> names = summands(part);
    const bool there = std::any_of(names.begin(), names.end(), [&](auto& name) {
        return image.layers.contains(name) || (name.empty() && picture_layer(image));
    });
    return there ? part_of(image, part, "the image") : Image(like.width, like.height, like.channels);
}

static std::vector<std::string> common_parts(const LayeredImage& test, const LayeredImage& reference) {
    std::vector<std::string> parts;
    for (const auto& [name, layer] : reference.layers) {
        if (name.rfind("out.", 0) == 0 && name != "out.display" && test.layers.count(name)) parts.push_back(name);
    }
    if (parts.empty() && test.layers.count("") && reference.layers.count("")) parts.push_back("");
    if (!parts.empty()) return parts;
    if (test.layers.size() == 1 && reference.layers.count(test.layers.begin()->first))
        return {test.layers.begin()->first};
    const std::string *whole = picture_layer(test), *reference_whole = picture_layer(reference);
    if (whole && reference_whole) return {*whole == *reference_whole ? *whole : ""};
    auto names = [](const LayeredImage& image) {
        std::vector<std::string> all;
        for (const auto& [name, layer] : image.layers)
            all.push_back(name.empty() ? "(unnamed)" : name);
        return join(all, ", ");
    };
    throw Error("the two images have no part in common: one has " + names(test) + "; the other has " +
                names(reference));
}

static const Image* find_layer(const LayeredImage& first, const LayeredImage& second, const std::string& name) {
    for (const LayeredImage* image : {&first, &second}) {
        auto layer = image->layers.find(name);
        if (layer != image->layers.end()) return &layer->second;
    }
    return nullptr;
}

static nlohmann::json metadata_of(const LayeredImage& image) {
    try {
        return parse_json(image.metadata, "metadata");
    } catch (const Error&) {
        return nullptr; // the picture counts without it
    }
}

/// The camera from either file's metadata.
static std::optional<glm::vec3> camera_position(const LayeredImage& first, const LayeredImage& second) {
    for (const LayeredImage* image : {&first, &second}) {
        const nlohmann::json json = metadata_of(*image);
        for (const char* pointer : {"/camera_position", "/camera/position"}) {
            const nlohmann::json::json_pointer at(pointer);
            if (!json.is_object() || !json.contains(at) || !json[at].is_array() || json[at].size() != 3) continue;
            const auto& p = json[at];
            if (p[0].is_number() && p[1].is_number() && p[2].is_number())
                return glm::vec3(float(p[0]), float(p[1]), float(p[2]));
        }
    }
    return std::nullopt;
}

/// The RMS standard error that a file tells of a part (sums: of independent parts).
static double told_noise(const LayeredImage& image, const std::string& part, bool off_edges) {
    const nlohmann::json json = metadata_of(image);
    double variance = 0;
    for (const std::string& name : split(part, '+')) {
        if (!json.is_object() || !json.contains("noise") || !json["noise"].contains(name)) continue;
        const auto& noise = json["noise"][name];
        const char* key = off_edges ? "rms_off_edges" : "rms";
        if (noise.is_object() && noise.contains(key) && noise[key].is_number()) {
            variance += double(noise[key]) * double(noise[key]);
        }
    }
    return std::sqrt(variance);
}

static Image three_channels(const Image& image) {
    if (image.channels == 3) return image;
    Image out(image.width, image.height, 3);
    for (size_t i = 0; i < size_t(image.width) * size_t(image.height); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            out.pixels[i * 3 + c] = image.pixels[i * size_t(image.channels) + (image.channels > 3 ? c : 0)];
        }
    }
    return out;
}

static Image luminance(const Image& image) {
    Image out(image.width, image.height, 1);
    for (size_t i = 0; i < out.pixels.size(); ++i) {
        const float* rgb = &image.pixels[i * 3];
        out.pixels[i] = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    }
    return out;
}

void match_channels(Image& a, Image& b) {
    if (a.channels == 4) a = three_channels(a);
    if (b.channels == 4) b = three_channels(b);
    if (a.channels == 1 && b.channels == 3) b = luminance(b);
    if (b.channels == 1 && a.channels == 3) a = luminance(a);
}

bool is_radiance(const std::string& part) {
    return part.find("ambient_occlusion") == std::string::npos && part.find("display") == std::string::npos;
}

/// The masked figures of two pictures of one part; with the metrics of display values where those are given.
static MetricValues compare_pair(const Image& a, const Image& b, const Mask& mask, double test_noise,
                                 double reference_noise, const Image* shown_a = nullptr, const Image* shown_b = nullptr,
                                 float ppd = k_flip_pixels_per_degree) {
    return compute_metrics(
        {a, b, mask, test_noise, reference_noise, error_figures(a, b, mask, reference_noise), shown_a, shown_b, ppd});
}

static PartComparison compare_part(const std::string& part, const LayeredImage& test, const LayeredImage& reference,
                                   const LayerComparison& of, const ComparisonOptions& options) {
    const std::string shown = part.empty() ? "the image" : part;
    Image b = part_of(reference, part, "the reference");
    Image a = options.absent_is_black ? part_or_black(test, part, b) : part_of(test, part, "the image");
    match_channels(a, b);
    check_same_size(a, shown + " of the image", b, shown + " of the reference");
    check_finite(a, shown + " of the image");
    check_finite(b, shown + " of the reference");
    const double test_noise = told_noise(test, part, of.edges_masked);
    const double reference_noise = told_noise(reference, part, of.edges_masked);
    PartComparison result;
    result.part = part;
    if (options.shown) {
        Image shown_a = three_channels(a), shown_b = three_channels(b);
        if (!options.display_values && is_radiance(part)) {
            result.exposure = options.exposure.value_or(automatic_exposure(shown_b, of.mask));
            shown_a = display_values(shown_a, result.exposure);
            shown_b = display_values(shown_b, result.exposure);
        }
        result.figures = compare_pair(a, b, of.mask, test_noise, reference_noise, &shown_a, &shown_b, options.ppd);
    } else {
        result.figures = compare_pair(a, b, of.mask, test_noise, reference_noise);
    }
    if (options.window != 1) {
        const Image mean_a = window_mean(a, of.mask, options.window), mean_b = window_mean(b, of.mask, options.window);
        const double less = window_noise_factor(of.mask, options.window);
        result.windowed = compare_pair(mean_a, mean_b, of.mask, less * test_noise, less * reference_noise);
    }
    return result;
}

LayerComparison compare_layers(const LayeredImage& test, const LayeredImage& reference,
                               const ComparisonOptions& options) {
    const std::vector<std::string> parts = options.parts.empty() ? common_parts(test, reference) : options.parts;
    LayerComparison comparison;
    {
        const Image first = part_of(reference, parts.front(), "the reference");
        comparison.mask = Mask(first.width, first.height);
    }
    const Image* normal = find_layer(reference, test, "gbuffer.normal");
    const Image* position = find_layer(reference, test, "gbuffer.position");
    const auto camera = camera_position(reference, test);
    if (options.mask_edges && normal && position && camera && normal->width == comparison.mask.width &&
        normal->height == comparison.mask.height) {
        comparison.mask = edge_mask(*normal, *position, *camera);
        comparison.edges_masked = comparison.mask.count() > 0;
        if (!comparison.edges_masked) comparison.mask = Mask(normal->width, normal->height);
    }
    for (const std::string& part : parts)
        comparison.parts.push_back(compare_part(part, test, reference, comparison, options));
    return comparison;
}

std::vector<SurfaceComparison> compare_surfaces(const LayeredImage& test, const LayeredImage& reference,
                                                const std::string& part, const Mask& mask) {
    static const char* const k_axes[6] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const Image* normal = find_layer(reference, test, "gbuffer.normal");
    const Image* material = find_layer(reference, test, "gbuffer.material");
    std::vector<SurfaceComparison> surfaces;
    if (!normal || !material) return surfaces;
    const Image ids = surface_ids(*material, *normal);
    Image a = part_of(test, part, "the image"), b = part_of(reference, part, "the reference");
    match_channels(a, b);
    for (const auto& [id, count] : component_counts(ids)) {
        const Mask own = mask & component_mask(ids, id);
        if (double(own.count()) < 0.005 * double(mask.count()) || own.count() == 0) continue;
        surfaces.push_back({id / 6, k_axes[id % 6], part, compare_pair(a, b, own, 0, 0)});
    }
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const auto& x, const auto& y) { return x.figures["pixels"] > y.figures["pixels"]; });
    return surfaces;
}

static Image averaged(const Image& image, int k, bool mean) {
    Image small(image.width / k, image.height / k, image.channels);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                double sum = 0;
                for (int j = 0; j < k; ++j)
                    for (int i = 0; i < k; ++i)
                        sum += image.at(x * k + i, y * k + j)[c];
                small.at(x, y)[c] = mean ? float(sum / (k * k)) : image.at(x * k + k / 2, y * k + k / 2)[c];
            }
        }
    }
    return small;
}

LayeredImage averaged_to_size_of(const LayeredImage& reference, LayeredImage image, int* k) {
    if (k) *k = 1;
    if (reference.layers.empty() || image.layers.empty()) return image;
    const Image& wanted = reference.layers.begin()->second;
    const Image& given = image.layers.begin()->second;
    const int times = wanted.width > 0 ? given.width / wanted.width : 0;
    for (const auto& [name, layer] : image.layers)
        if (times < 2 || layer.width != times * wanted.width || layer.height != times * wanted.height) return image;
    for (auto& [name, layer] : image.layers)
        layer = averaged(layer, times, !name.starts_with("gbuffer."));
    // The noise that it tells of itself was that of its own pixels.
    nlohmann::json json = metadata_of(image);
    if (json.is_object() && json.erase("noise") > 0) image.metadata = json.dump();
    if (k) *k = times;
    return image;
}

LayeredImage read_picture(const std::filesystem::path& path, bool& display, PicturePlace* place) {
    display = false;
    if (place) *place = {};
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) { return char(std::tolower(c)); });
    LayeredImage picture;
    if (extension == ".exr") {
        ExrPicture read = read_exr_picture(path, ExrChannels::radiance);
        if (place) *place = {read.x, read.y, read.outside};
        return std::move(read.image);
    }
    if (extension == ".hdr") {
        picture.layers[""] = read_hdr(path);
        return picture;
    }
    const Image8 encoded = read_image8(path);
    Image image(encoded.width, encoded.height, 3);
    for (size_t i = 0; i < size_t(image.width) * size_t(image.height); ++i) {
        for (size_t c = 0; c < 3; ++c)
            image.pixels[i * 3 + c] = srgb_decode(float(encoded.rgba[i * 4 + c]) / 255);
    }
    picture.layers[""] = std::move(image);
    display = true;
    return picture;
}

} // namespace bounce
