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

namespace {

/// How many texels have each alpha.
std::array<size_t, 256> alpha_histogram(const Image8& image) {
    std::array<size_t, 256> count{};
    for (size_t i = 3; i < image.rgba.size(); i += 4)
        ++count[image.rgba[i]];
    return count;
}

} // namespace

void keep_coverage(const Image8& whole, std::vector<Image8>& levels, float cutoff) {
    const size_t first = size_t(std::clamp(std::ceil(cutoff * 255), 0.0f, 256.0f)); // the lowest code that passes
    const std::array<size_t, 256> all = alpha_histogram(whole);
    size_t pass = 0, texels = 0;
    for (size_t code = 0; code < 256; ++code) {
        texels += all[code];
        pass += code >= first ? all[code] : 0;
    }
    if (first == 0 || first > 255 || pass == 0 || pass == texels) return; // nothing that a scale could keep
    for (Image8& level : levels) {
        const std::array<size_t, 256> count = alpha_histogram(level);
        const double wanted = double(pass) / double(texels) * double(level.rgba.size() / 4);
        // The code from which on the level's texels are as many as wanted, as nearly as codes allow.
        size_t border = 256, above = 0;
        double best = wanted;
        for (size_t code = 255; code > 0; --code) {
            above += count[code];
            if (const double off = std::abs(double(above) - wanted); count[code] && off < best) {
                best = off;
                border = code;
            }
        }
        // Any code down to the next that is there does the same: the one nearest to the cutoff changes least.
        size_t lower = border;
        while (lower > 0 && (lower > 255 || lower == border || !count[lower]))
            --lower;
        border = std::clamp(first, lower + 1, border);
        for (size_t i = 3; i < level.rgba.size(); i += 4) {
            const int code = level.rgba[i];
            // `border` becomes the first code that passes; above it alphas keep their share of the way to 255.
            const bool passes = size_t(code) >= border;
            const double scaled = border > 255 || !passes
                                      ? double(code) * double(first) / double(std::min<size_t>(border, 256))
                                      : double(first) + (double(code) - double(border)) * double(255 - first) /
                                                            std::max(1.0, double(255 - border));
            const int rounded = int(std::lround(scaled));
            level.rgba[i] =
                uint8_t(passes ? std::clamp(rounded, int(first), 255) : std::clamp(rounded, 0, int(first) - 1));
        }
    }
}

} // namespace bounce
