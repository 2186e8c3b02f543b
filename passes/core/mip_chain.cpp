#include "core/mip_chain.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bounce {

namespace {

struct Level {
    int width = 0, height = 0;
    std::vector<float> rgba;
};

/// Codes to values and back to the nearest code.
struct Encoding {
    std::array<float, 256> values;
    std::array<float, 255> borders; ///< between each code and the next
    explicit Encoding(bool srgb) {
        auto decode = [srgb](float code) { return srgb ? srgb_decode(code / 255) : code / 255; };
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = decode(float(i));
        for (size_t i = 0; i < borders.size(); ++i)
            borders[i] = decode(float(i) + 0.5f);
    }
    uint8_t code(float value) const {
        return uint8_t(std::upper_bound(borders.begin(), borders.end(), value) - borders.begin());
    }
};

/// The mean over each texel's own stretch of a row of `size` texels: first texel, count and weights.
struct Stretch {
    int first = 0, count = 0;
    float weights[3] = {0, 0, 0};
};

std::vector<Stretch> stretches(int size, int smaller) {
    std::vector<Stretch> out(static_cast<size_t>(smaller));
    const double length = double(size) / smaller; // 2, or up to 3 where the size is odd
    for (int i = 0; i < smaller; ++i) {
        Stretch& s = out[size_t(i)];
        const double from = i * length, to = (i + 1) * length;
        s.first = int(from);
        for (int t = s.first; t < size && t < to && s.count < 3; ++t)
            s.weights[s.count++] = float((std::min<double>(t + 1, to) - std::max<double>(t, from)) / length);
    }
    return out;
}

template <class Read>
Level halved(int width, int height, Read&& read) {
    Level out{std::max(1, width / 2), std::max(1, height / 2), {}};
    out.rgba.resize(size_t(out.width) * size_t(out.height) * 4);
    const std::vector<Stretch> columns = stretches(width, out.width), rows = stretches(height, out.height);
    float* to = out.rgba.data();
    for (const Stretch& row : rows) {
        for (const Stretch& column : columns) {
            float sum[4] = {0, 0, 0, 0};
            for (int j = 0; j < row.count; ++j) {
                for (int i = 0; i < column.count; ++i) {
                    const float weight = row.weights[j] * column.weights[i];
                    const size_t at = (size_t(row.first + j) * size_t(width) + size_t(column.first + i)) * 4;
                    for (size_t c = 0; c < 4; ++c)
                        sum[c] += weight * read(at, c);
                }
            }
            to = std::copy_n(sum, 4, to);
        }
    }
    return out;
}

} // namespace

std::vector<Image8> mip_chain(const Image8& image, bool srgb) {
    std::vector<Image8> levels;
    const Encoding colour(srgb), alpha(false);
    Level level;
    for (int width = image.width, height = image.height; width > 1 || height > 1;) {
        if (levels.empty()) {
            level = halved(width, height,
                           [&](size_t at, size_t c) { return (c == 3 ? alpha : colour).values[image.rgba[at + c]]; });
        } else {
            level = halved(width, height, [&level](size_t at, size_t c) { return level.rgba[at + c]; });
        }
        width = level.width;
        height = level.height;
        Image8 codes{width, height, std::vector<uint8_t>(level.rgba.size())};
        for (size_t i = 0; i < level.rgba.size(); ++i)
            codes.rgba[i] = (i % 4 == 3 ? alpha : colour).code(level.rgba[i]);
        levels.push_back(std::move(codes));
    }
    return levels;
}

} // namespace bounce
