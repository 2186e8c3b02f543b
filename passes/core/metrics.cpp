#include "core/metrics.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace bounce {

void check_finite(const Image& image, const std::string& what) {
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        if (std::isfinite(image.pixels[i])) continue;
        size_t pixel = i / size_t(image.channels);
        throw Error(
            fmt::format("{}: the value at pixel ({}, {}), channel {}, is {}; only finite values can be compared", what,
                        pixel % size_t(image.width), pixel / size_t(image.width), i % size_t(image.channels),
                        std::isnan(image.pixels[i]) ? "NaN" : "infinite"));
    }
}

void check_same_size(const Image& a, const std::string& what_a, const Image& b, const std::string& what_b) {
    if (a.width == b.width && a.height == b.height && a.channels == b.channels) return;
    throw Error(fmt::format("{} is {}x{} with {} channels, but {} is {}x{} with {}; they must be alike to be compared",
                            what_a, a.width, a.height, a.channels, what_b, b.width, b.height, b.channels));
}

static void check_mask(const Image& image, const Mask& mask) {
    if (mask.width != image.width || mask.height != image.height) {
        throw Error(fmt::format("the mask is {}x{}, but the image is {}x{}", mask.width, mask.height, image.width,
                                image.height));
    }
    if (mask.count() == 0) throw Error("the mask keeps no pixel, so there is nothing to compare");
}

static double ratio_to_mean(double value, double mean) {
    if (mean != 0) return value / std::abs(mean);
    return value == 0 ? 0 : std::numeric_limits<double>::infinity();
}

ErrorFigures error_figures(const Image& test, const Image& reference, const Mask& mask, double reference_rms_noise) {
    check_same_size(test, "the image", reference, "the reference");
    check_finite(test, "the image");
    check_finite(reference, "the reference");
    check_mask(reference, mask);

    ErrorFigures figures;
    figures.pixels = mask.count();
    figures.mean = image_mean(test, mask);
    figures.reference_mean = image_mean(reference, mask);
    const double epsilon = 0.01 * figures.reference_mean * figures.reference_mean;
    const double floor = 0.01 * std::abs(figures.reference_mean);
    const size_t channels = size_t(test.channels);
    double squares = 0, relative_squares = 0, smape = 0;
    std::vector<double> relative_errors;
    relative_errors.reserve(figures.pixels);
    for (size_t pixel = 0; pixel < mask.keep.size(); ++pixel) {
        if (!mask.keep[pixel]) continue;
        double pixel_difference = 0, pixel_reference = 0;
        for (size_t c = 0; c < channels; ++c) {
            double a = test.pixels[pixel * channels + c];
            double b = reference.pixels[pixel * channels + c];
            double difference = std::abs(a - b);
            squares += difference * difference;
            // Where the whole reference is black, any difference is infinitely large beside it.
            if (difference > 0) relative_squares += difference * difference / (b * b + epsilon);
            if (difference > 0) smape += difference / (std::abs(a) + std::abs(b));
            figures.largest_error = std::max(figures.largest_error, difference);
            pixel_difference += difference / double(channels);
            pixel_reference += std::abs(b) / double(channels);
        }
        relative_errors.push_back(pixel_difference == 0 ? 0 : pixel_difference / (pixel_reference + floor));
    }
    const double count = double(figures.pixels * channels);
    const double mean_square = squares / count;
    figures.bias = ratio_to_mean(figures.mean - figures.reference_mean, figures.reference_mean);
    figures.rmse = std::sqrt(mean_square);
    figures.relative_rmse = ratio_to_mean(figures.rmse, figures.reference_mean);
    figures.relative_mse = relative_squares / count;
    figures.smape = smape / count;
    // The smallest value that at least 99 % of the pixels do not exceed.
    size_t rank = size_t(std::ceil(0.99 * double(relative_errors.size()))) - 1;
    std::nth_element(relative_errors.begin(), relative_errors.begin() + ptrdiff_t(rank), relative_errors.end());
    figures.relative_error_p99 = relative_errors[rank];
    figures.reference_noise = ratio_to_mean(reference_rms_noise, figures.reference_mean);
    figures.relative_rmse_denoised = ratio_to_mean(
        std::sqrt(std::max(0.0, mean_square - reference_rms_noise * reference_rms_noise)), figures.reference_mean);
    return figures;
}

ErrorFigures error_figures(const Image& test, const Image& reference) {
    return error_figures(test, reference, Mask(reference.width, reference.height));
}

double image_mean(const Image& image, const Mask& mask) {
    check_mask(image, mask);
    double sum = 0;
    for (size_t pixel = 0; pixel < mask.keep.size(); ++pixel) {
        if (!mask.keep[pixel]) continue;
        for (int c = 0; c < image.channels; ++c)
            sum += image.pixels[pixel * size_t(image.channels) + size_t(c)];
    }
    return sum / double(mask.count() * size_t(image.channels));
}

double half_image_noise(const Image& half_a, const Image& half_b, const Mask& mask) {
    check_same_size(half_a, "one half", half_b, "the other half");
    check_mask(half_a, mask);
    const size_t channels = size_t(half_a.channels);
    double squares = 0;
    for (size_t i = 0; i < half_a.pixels.size(); ++i) {
        if (!mask.keep[i / channels]) continue;
        double half_difference = 0.5 * (double(half_a.pixels[i]) - half_b.pixels[i]);
        squares += half_difference * half_difference;
    }
    return std::sqrt(squares / double(mask.count() * channels));
}

Image display_values(const Image& radiance, float exposure) {
    Image display = radiance;
    const float scale = std::exp2(exposure);
    for (float& value : display.pixels) {
        float x = std::max(0.0f, value * scale);
        // The curve is x² over x² far out; that limit keeps inf/inf away.
        float y = x > 1.0e4f ? 1.0f : x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
        value = std::clamp(y, 0.0f, 1.0f);
    }
    return display;
}

float automatic_exposure(const Image& reference, const Mask& mask) {
    check_mask(reference, mask);
    double sum = 0;
    for (size_t pixel = 0; pixel < mask.keep.size(); ++pixel) {
        if (!mask.keep[pixel]) continue;
        const float* p = &reference.pixels[pixel * size_t(reference.channels)];
        sum += reference.channels >= 3 ? 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] : p[0];
    }
    double mean = sum / double(mask.count());
    return mean > 0 ? float(std::log2(0.18 / mean)) : 0.0f;
}

} // namespace bounce
