#include "core/window_mean.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

/// Sums over n × n windows of one value a pixel, first along rows, then along columns.
std::vector<double> window_sums(const std::vector<double>& values, int width, int height, int n) {
    const int r = n / 2;
    std::vector<double> rows(values.size()), sums(values.size());
    auto at = [&](int x, int y) { return size_t(y) * size_t(width) + size_t(x); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int i = std::max(0, x - r); i <= std::min(width - 1, x + r); ++i)
                rows[at(x, y)] += values[at(i, y)];
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int j = std::max(0, y - r); j <= std::min(height - 1, y + r); ++j) {
            for (int x = 0; x < width; ++x)
                sums[at(x, y)] += rows[at(x, j)];
        }
    }
    return sums;
}

std::vector<double> kept_in_window(const Mask& mask, int n) {
    if (n < 1 || n % 2 == 0) throw Error(fmt::format("invalid window '{}': expected an odd number from 1", n));
    return window_sums({mask.keep.begin(), mask.keep.end()}, mask.width, mask.height, n);
}

} // namespace

Image window_mean(const Image& image, const Mask& mask, int n) {
    const std::vector<double> kept = kept_in_window(mask, n);
    if (image.width != mask.width || image.height != mask.height) throw Error("the mask is of another size");
    Image out = image;
    const size_t channels = size_t(image.channels);
    std::vector<double> values(mask.keep.size());
    for (size_t c = 0; c < channels; ++c) {
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = mask.keep[i] ? double(image.pixels[i * channels + c]) : 0;
        const std::vector<double> sums = window_sums(values, mask.width, mask.height, n);
        for (size_t i = 0; i < values.size(); ++i)
            if (mask.keep[i]) out.pixels[i * channels + c] = float(sums[i] / kept[i]);
    }
    return out;
}

double window_noise_factor(const Mask& mask, int n) {
    const std::vector<double> kept = kept_in_window(mask, n);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < kept.size(); ++i) {
        if (!mask.keep[i]) continue;
        sum += 1 / kept[i];
        ++count;
    }
    return count ? std::sqrt(sum / double(count)) : 1;
}

} // namespace bounce
