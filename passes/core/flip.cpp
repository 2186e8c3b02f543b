// The pipeline of the paper: a colour difference of contrast-filtered images (Section 4.1), raised by a difference of
// edges and points (Section 4.2), joined in Section 4.3. Symbols are the paper's.

#include "core/flip.h"

#include "core/error.h"
#include "core/filter.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace bounce {

namespace {

constexpr float k_qc = 0.7f;              ///< exponent of the HyAB distance
constexpr float k_pc = 0.4f;              ///< share of the largest colour error that is stretched
constexpr float k_pt = 0.95f;             ///< … over this part of the output
constexpr float k_qf = 0.5f;              ///< exponent of the feature difference
constexpr float k_feature_width = 0.082f; ///< peak to trough of the eye's edge detector, degrees

using Plane = std::vector<float>;
struct Planes {
    Plane c[3];
};

} // namespace

static glm::vec3 linear_to_xyz(const glm::vec3& rgb) {
    // sRGB primaries, D65, in the exact fractions that make white (0.95047, 1, 1.08883) to all digits.
    return {(10135552.0f * rgb.r + 8788810.0f * rgb.g + 4435075.0f * rgb.b) / 24577794.0f,
            (2613072.0f * rgb.r + 8788810.0f * rgb.g + 887015.0f * rgb.b) / 12288897.0f,
            (1425312.0f * rgb.r + 8788810.0f * rgb.g + 70074185.0f * rgb.b) / 73733382.0f};
}

static glm::vec3 white() {
    return linear_to_xyz(glm::vec3(1.0f));
}

static glm::vec3 xyz_to_linear(const glm::vec3& xyz) {
    static const glm::mat3 inverse = [] {
        glm::dmat3 forward;
        for (int c = 0; c < 3; ++c) {
            glm::vec3 unit(0);
            unit[c] = 1;
            forward[c] = glm::dvec3(linear_to_xyz(unit));
        }
        return glm::mat3(glm::inverse(forward));
    }();
    return inverse * xyz;
}

/// The linear opponent space YCxCz, in which the contrast sensitivity is modelled.
static glm::vec3 linear_to_ycxcz(const glm::vec3& rgb) {
    glm::vec3 t = linear_to_xyz(rgb) / white();
    return {116.0f * t.y - 16.0f, 500.0f * (t.x - t.y), 200.0f * (t.y - t.z)};
}

static glm::vec3 ycxcz_to_linear(const glm::vec3& ycxcz) {
    float y = (ycxcz.x + 16.0f) / 116.0f;
    return xyz_to_linear(glm::vec3(y + ycxcz.y / 500.0f, y, y - ycxcz.z / 200.0f) * white());
}

/// CIELAB with the Hunt adjustment: chroma weakens with lightness.
static glm::vec3 hunt_lab(const glm::vec3& rgb) {
    glm::vec3 t = linear_to_xyz(rgb) / white();
    for (int c = 0; c < 3; ++c) {
        constexpr float delta = 6.0f / 29.0f;
        t[c] = t[c] > delta * delta * delta ? std::cbrt(t[c]) : t[c] / (3 * delta * delta) + 4.0f / 29.0f;
    }
    float lightness = 116.0f * t.y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (t.x - t.y), 0.01f * lightness * 200.0f * (t.y - t.z)};
}

static float hyab(const glm::vec3& a, const glm::vec3& b) {
    glm::vec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

static Planes opponent_planes(const Image& image) {
    Planes planes;
    size_t count = size_t(image.width) * size_t(image.height);
    for (Plane& plane : planes.c)
        plane.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const float* p = &image.pixels[i * size_t(image.channels)];
        glm::vec3 colour = linear_to_ycxcz(glm::clamp(glm::vec3(p[0], p[1], p[2]), 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c)
            planes.c[c][i] = colour[c];
    }
    return planes;
}

/// The contrast sensitivity filters (Table 1 of the paper): sums of Gaussians a·√(π/b)·exp(−π²x²/b), x in degrees.
static void contrast_filter(Planes& planes, int width, int height, float ppd) {
    struct Gaussian {
        float a, b;
    };
    struct Sum {
        Gaussian first, second;
    };
    static constexpr Sum k_sums[3] = {
        {{1.0f, 0.0047f}, {0.0f, 1e-5f}}, {{1.0f, 0.0053f}, {0.0f, 1e-5f}}, {{34.1f, 0.04f}, {13.5f, 0.025f}}};
    constexpr float pi = 3.14159265358979f;
    const int radius = int(std::ceil(3.0f * std::sqrt(0.04f / (2 * pi * pi)) * ppd));
    for (int c = 0; c < 3; ++c) {
        Plane total(planes.c[c].size(), 0.0f);
        float weights[2], sum = 0;
        Plane kernels[2];
        for (int g = 0; g < 2; ++g) {
            const Gaussian gaussian = g == 0 ? k_sums[c].first : k_sums[c].second;
            float line = 0;
            for (int i = -radius; i <= radius; ++i) {
                float x = float(i) / ppd;
                kernels[g].push_back(std::exp(-pi * pi * x * x / gaussian.b));
                line += kernels[g].back();
            }
            for (float& value : kernels[g])
                value /= line;
            weights[g] = gaussian.a * std::sqrt(pi / gaussian.b) * line * line;
            sum += weights[g];
        }
        for (int g = 0; g < 2; ++g) {
            if (weights[g] == 0) continue;
            Plane filtered = convolve(planes.c[c], width, height, kernels[g], kernels[g], Border::nearest);
            for (size_t i = 0; i < total.size(); ++i)
                total[i] += weights[g] / sum * filtered[i];
        }
        planes.c[c] = std::move(total);
    }
}

/// The length of the edge (first derivative) and point (second derivative) response to the luminance.
static void features(const Plane& y_plane, int width, int height, float ppd, Plane& edges, Plane& points) {
    Plane luminance(y_plane.size());
    for (size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = (y_plane[i] + 16.0f) / 116.0f;
    const float deviation = 0.5f * k_feature_width * ppd;
    const int radius = int(std::ceil(3 * deviation));
    Plane gaussian, first, second;
    float gaussian_sum = 0, first_sum = 0, second_positive = 0, second_negative = 0;
    for (int i = -radius; i <= radius; ++i) {
        float x = float(i);
        float g = std::exp(-x * x / (2 * deviation * deviation));
        gaussian.push_back(g);
        first.push_back(-x * g);
        second.push_back((x * x / (deviation * deviation) - 1) * g);
        gaussian_sum += g;
        first_sum += std::max(0.0f, first.back());
        second_positive += std::max(0.0f, second.back());
        second_negative -= std::min(0.0f, second.back());
    }
    // Positive weights sum to 1 and negative ones to −1, as a whole two-dimensional filter.
    for (float& value : gaussian)
        value /= gaussian_sum;
    for (float& value : first)
        value /= first_sum;
    for (float& value : second)
        value /= value > 0 ? second_positive : second_negative;
    auto response = [&](const Plane& derivative) {
        Plane x = convolve(luminance, width, height, derivative, gaussian, Border::nearest);
        Plane y = convolve(luminance, width, height, gaussian, derivative, Border::nearest);
        for (size_t i = 0; i < x.size(); ++i)
            x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
        return x;
    };
    edges = response(first);
    points = response(second);
}

/// Maps HyAB^qc to [0, 1]: the lower part, where most errors are, gets most of the range.
static float redistribute(float error, float largest) {
    const float knee = k_pc * largest;
    return error < knee ? k_pt / knee * error : k_pt + (error - knee) / (largest - knee) * (1 - k_pt);
}

float pixels_per_degree(float distance, float display_width, int display_pixels) {
    if (!(distance > 0) || !(display_width > 0) || display_pixels <= 0) {
        throw Error("pixels per degree needs a distance, a display width and a pixel count above 0");
    }
    return distance * (float(display_pixels) / display_width) * (3.14159265358979f / 180.0f);
}

Image flip(const Image& test, const Image& reference, float ppd) {
    check_same_size(test, "the image", reference, "the reference");
    if (test.channels < 3) throw Error("FLIP compares RGB images; these have fewer than three channels");
    if (!(ppd > 0) || ppd > 1000) throw Error("FLIP needs pixels per degree between 0 and 1000");
    check_finite(test, "the image");
    check_finite(reference, "the reference");

    const int width = test.width, height = test.height;
    Planes a = opponent_planes(test), b = opponent_planes(reference);
    Plane edges_a, edges_b, points_a, points_b;
    features(a.c[0], width, height, ppd, edges_a, points_a);
    features(b.c[0], width, height, ppd, edges_b, points_b);
    contrast_filter(a, width, height, ppd);
    contrast_filter(b, width, height, ppd);

    const float largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), k_qc);
    Image map(width, height, 1);
    for (size_t i = 0; i < map.pixels.size(); ++i) {
        auto colour = [i](const Planes& planes) {
            glm::vec3 linear = ycxcz_to_linear({planes.c[0][i], planes.c[1][i], planes.c[2][i]});
            return hunt_lab(glm::clamp(linear, 0.0f, 1.0f));
        };
        float colour_error = redistribute(std::pow(hyab(colour(b), colour(a)), k_qc), largest);
        float feature = std::max(std::abs(edges_b[i] - edges_a[i]), std::abs(points_b[i] - points_a[i]));
        float feature_error = std::clamp(std::pow(feature / std::sqrt(2.0f), k_qf), 0.0f, 1.0f);
        map.pixels[i] = std::clamp(std::pow(colour_error, 1.0f - feature_error), 0.0f, 1.0f);
    }
    return map;
}

double flip_mean(const Image& map, const Mask& mask) {
    return image_mean(map, mask);
}

} // namespace bounce
