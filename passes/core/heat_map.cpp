#include "core/heat_map.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bounce {

glm::vec3 magma(float t) {
    t = t > 0 ? std::min(t, 1.0f) : 0.0f;
    // A fit of degree six to the published table, within 2 %.
    const glm::vec3 c0(-0.002136485f, -0.000749655f, -0.005386128f);
    const glm::vec3 c1(0.251660541f, 0.677523244f, 2.494026599f);
    const glm::vec3 c2(8.353717279f, -3.577719515f, 0.314467903f);
    const glm::vec3 c3(-27.66873309f, 14.26473078f, -13.64921319f);
    const glm::vec3 c4(52.17613981f, -27.94360607f, 12.94416944f);
    const glm::vec3 c5(-50.76852536f, 29.04658282f, 4.234152994f);
    const glm::vec3 c6(18.65570507f, -11.48977352f, -5.601961509f);
    return glm::clamp(c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6))))), 0.0f, 1.0f);
}

Image8 heat_map(const Image& values, float low, float high, const Mask& mask) {
    if (values.empty() || values.channels != 1) throw Error("a heat map is made from an image of one channel");
    if (mask.width != values.width || mask.height != values.height)
        throw Error("the mask differs in size from the image");
    if (!(high > low)) throw Error("the upper end of a heat map's range must be above the lower end");
    Image8 map;
    map.width = values.width;
    map.height = values.height;
    map.rgba.resize(values.pixels.size() * 4);
    for (size_t i = 0; i < values.pixels.size(); ++i) {
        glm::vec3 colour = magma((values.pixels[i] - low) / (high - low));
        if (!std::isfinite(values.pixels[i])) colour = {0, 1, 0};
        if (!mask.keep[i]) colour = glm::vec3(0.35f);
        for (int c = 0; c < 3; ++c)
            map.rgba[i * 4 + size_t(c)] = uint8_t(std::lround(255 * colour[c]));
        map.rgba[i * 4 + 3] = 255;
    }
    return map;
}

Image8 heat_map(const Image& values, float low, float high) {
    return heat_map(values, low, high, Mask(values.width, values.height));
}

Image relative_error_map(const Image& test, const Image& reference) {
    check_same_size(test, "the image", reference, "the reference");
    double sum = 0;
    for (float value : reference.pixels)
        sum += value;
    const double mean = sum / double(reference.pixels.size());
    Image map(test.width, test.height, 1);
    for (size_t i = 0; i < map.pixels.size(); ++i) {
        double difference = 0;
        for (int c = 0; c < test.channels; ++c) {
            size_t at = i * size_t(test.channels) + size_t(c);
            difference += std::abs(double(test.pixels[at]) - reference.pixels[at]) / test.channels;
        }
        double relative = difference == 0 ? 0 : mean == 0 ? std::numeric_limits<double>::infinity() : difference / mean;
        map.pixels[i] = float(relative);
    }
    return map;
}

} // namespace bounce
