#include "app/experiments/parts.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"

#include <cmath>
namespace bounce {

Image sum_of_parts(const LayeredImage& image, const std::vector<std::string>& parts) {
    Image sum;
    for (const std::string& part : parts) {
        auto layer = image.layers.find(part);
        if (layer == image.layers.end()) continue;
        if (sum.empty()) {
            sum = layer->second;
            continue;
        }
        if (sum.pixels.size() != layer->second.pixels.size())
            throw Error("part '" + part + "' is of another size than the others");
        for (size_t i = 0; i < sum.pixels.size(); ++i)
            sum.pixels[i] += layer->second.pixels[i];
    }
    if (!sum.empty()) return sum;
    if (image.layers.empty()) throw Error("there are no parts");
    const Image& like = image.layers.begin()->second;
    bool any_out = false;
    for (const auto& [name, layer] : image.layers)
        any_out = any_out || name.starts_with("out.");
    if (!any_out) throw Error("there is no part " + join(parts, ", "));
    return Image(like.width, like.height, 3);
}

double noise_of_parts(const LayeredImage& reference, const std::vector<std::string>& parts) {
    nlohmann::json json;
    try {
        json = parse_json(reference.metadata, "metadata");
    } catch (const Error&) {
        return 0;
    }
    if (!json.is_object() || !json.contains("noise")) return 0;
    double variance = 0, mean = 0;
    for (const std::string& part : parts) {
        if (!json["noise"].contains(part)) continue;
        const auto& noise = json["noise"][part];
        double rms = noise.value("rms_off_edges", 0.0);
        variance += rms * rms;
        mean += noise.value("mean_off_edges", 0.0);
    }
    return mean > 0 ? std::sqrt(variance) / mean : 0;
}

} // namespace bounce
