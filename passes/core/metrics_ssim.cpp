// Structural similarity.

#include "core/error.h"
#include "core/filter.h"
#include "core/metrics.h"

#include <algorithm>
#include <cmath>

namespace bounce {

static std::vector<float> luma(const Image& image) {
    std::vector<float> values(size_t(image.width) * size_t(image.height));
    for (size_t i = 0; i < values.size(); ++i) {
        const float* p = &image.pixels[i * size_t(image.channels)];
        values[i] = image.channels >= 3
                        ? 0.299f * srgb_encode(p[0]) + 0.587f * srgb_encode(p[1]) + 0.114f * srgb_encode(p[2])
                        : srgb_encode(p[0]);
    }
    return values;
}

static std::vector<float> product(const std::vector<float>& a, const std::vector<float>& b) {
    std::vector<float> values(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        values[i] = a[i] * b[i];
    return values;
}

double ssim(const Image& test, const Image& reference, const Mask& mask) {
    check_same_size(test, "the image", reference, "the reference");
    check_finite(test, "the image");
    check_finite(reference, "the reference");
    const int width = test.width, height = test.height;
    if (mask.width != width || mask.height != height || mask.count() == 0) {
        throw Error("the mask keeps no pixel or does not have the image's size");
    }
    std::vector<float> kernel(11);
    for (int i = 0; i < 11; ++i)
        kernel[size_t(i)] = std::exp(-float((i - 5) * (i - 5)) / (2 * 1.5f * 1.5f));
    auto blur = [&](const std::vector<float>& image) {
        return convolve(image, width, height, kernel, kernel, Border::cut);
    };
    const std::vector<float> a = luma(test), b = luma(reference);
    const std::vector<float> mean_a = blur(a), mean_b = blur(b);
    const std::vector<float> aa = blur(product(a, a)), bb = blur(product(b, b)), ab = blur(product(a, b));
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (!mask.keep[i]) continue;
        const double ma = mean_a[i], mb = mean_b[i];
        const double variance_a = std::max(0.0, aa[i] - ma * ma), variance_b = std::max(0.0, bb[i] - mb * mb);
        const double covariance = ab[i] - ma * mb;
        sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
    }
    return sum / double(mask.count());
}

} // namespace bounce
