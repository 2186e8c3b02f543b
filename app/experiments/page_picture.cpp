#include "app/experiments/page_picture.h"

#include "core/base64.h"
#include "core/heat_map.h"

#include <algorithm>
#include <cmath>

namespace bounce {

namespace {

/// The pixels of a picture that fall into one of a smaller one.
struct Area {
    int x0, x1, y0, y1;

    Area(int x, int y, const Image& from, int width, int height)
        : x0(x * from.width / width), x1(std::max(x0 + 1, (x + 1) * from.width / width)), y0(y * from.height / height),
          y1(std::max(y0 + 1, (y + 1) * from.height / height)) {}
};

int height_of(const Image& image, int width) {
    return std::max(1, image.height * width / image.width);
}

} // namespace

std::string page_picture(const Image& linear, bool light, float exposure, int max_width) {
    const Image display = light ? display_values(linear, exposure) : linear;
    const int width = std::min(max_width, display.width), height = height_of(display, width);
    Image8 out{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4, 255)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Area area(x, y, display, width, height);
            float sum[3] = {};
            for (int sy = area.y0; sy < area.y1; ++sy) {
                for (int sx = area.x0; sx < area.x1; ++sx) {
                    for (int c = 0; c < 3; ++c)
                        sum[c] += std::clamp(display.at(sx, sy)[display.channels >= 3 ? c : 0], 0.0f, 1.0f);
                }
            }
            const float pixels = float((area.x1 - area.x0) * (area.y1 - area.y0));
            for (int c = 0; c < 3; ++c)
                out.rgba[(size_t(y) * size_t(width) + size_t(x)) * 4 + size_t(c)] =
                    uint8_t(std::lround(255 * srgb_encode(sum[c] / pixels)));
        }
    }
    return base64(encode_png(out));
}

std::string page_error_map(const Image& errors, float top, const Mask& mask, int max_width) {
    const int width = std::min(max_width, errors.width), height = height_of(errors, width);
    Image small(width, height, 1);
    Mask kept(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Area area(x, y, errors, width, height);
            const size_t at = size_t(y) * size_t(width) + size_t(x);
            float sum = 0;
            int count = 0;
            for (int sy = area.y0; sy < area.y1; ++sy) {
                for (int sx = area.x0; sx < area.x1; ++sx) {
                    if (!mask.keep[size_t(sy) * size_t(errors.width) + size_t(sx)]) continue;
                    sum += errors.at(sx, sy)[0];
                    ++count;
                }
            }
            kept.keep[at] = count > 0;
            small.pixels[at] = count > 0 ? sum / float(count) : 0;
        }
    }
    return base64(encode_png(heat_map(small, 0, top, kept)));
}

} // namespace bounce
