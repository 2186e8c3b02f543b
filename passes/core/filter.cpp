#include "core/filter.h"

#include <algorithm>

namespace bounce {

/// One pass along a line: `step` apart in memory, `count` pixels.
static void convolve_line(const float* in, float* out, int count, size_t step, const std::vector<float>& kernel,
                          Border border) {
    const int radius = int(kernel.size() / 2);
    for (int i = 0; i < count; ++i) {
        double sum = 0, weight = 0;
        for (int k = -radius; k <= radius; ++k) {
            int at = i + k;
            if (at < 0 || at >= count) {
                if (border == Border::cut) continue;
                at = std::clamp(at, 0, count - 1);
            }
            sum += double(kernel[size_t(k + radius)]) * in[size_t(at) * step];
            weight += kernel[size_t(k + radius)];
        }
        out[size_t(i) * step] = float(border == Border::cut ? sum / weight : sum);
    }
}

std::vector<float> convolve(const std::vector<float>& image, int width, int height, const std::vector<float>& across,
                            const std::vector<float>& down, Border border) {
    std::vector<float> half(image.size()), out(image.size());
    for (int y = 0; y < height; ++y) {
        size_t row = size_t(y) * size_t(width);
        convolve_line(&image[row], &half[row], width, 1, across, border);
    }
    for (int x = 0; x < width; ++x)
        convolve_line(&half[size_t(x)], &out[size_t(x)], height, size_t(width), down, border);
    return out;
}

} // namespace bounce
