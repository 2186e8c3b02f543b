#include "ldm/directions.h"

#include "core/low_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>

namespace bounce {

using std::numbers::pi;

static double colatitude_of_share(double share) {
    return 2 * std::asin(std::sqrt(std::clamp(share, 0.0, 1.0)));
}

static glm::dvec3 on_sphere(double colatitude, double longitude) {
    double sine = std::sin(colatitude);
    return {sine * std::cos(longitude), sine * std::sin(longitude), std::cos(colatitude)};
}

std::vector<ZonalRegion> zonal_equal_area_partition(int n) {
    if (n == 1) return {{0, pi, 0, 2 * pi, {0, 0, 1}}};
    double cap = colatitude_of_share(1.0 / n);
    // Collars between the caps: about as high as a region is wide.
    int collars = n > 2 ? std::max(1, int(std::round((pi - 2 * cap) / std::sqrt(4 * pi / n)))) : 0;
    double height = collars ? (pi - 2 * cap) / collars : 0;
    auto area_above = [](double colatitude) { return 4 * pi * std::pow(std::sin(0.5 * colatitude), 2); };
    std::vector<ZonalRegion> regions{{0, cap, 0, 2 * pi, {0, 0, 1}}};
    double carried = 0, offset = 0; // offset in turns
    int above = 1, before = 0;      // regions so far; those of the collar before
    for (int collar = 0; collar < collars; ++collar) {
        double ideal =
            (area_above(cap + (collar + 1) * height) - area_above(cap + collar * height)) / (4 * pi / n) + carried;
        int count = int(std::round(ideal));
        carried = ideal - count;
        double low = colatitude_of_share(double(above) / n), high = colatitude_of_share(double(above + count) / n);
        if (before > 0) {
            offset += 0.5 * (1.0 / count - 1.0 / before) + double(std::gcd(count, before)) / (2.0 * count * before);
            offset -= std::floor(offset);
        }
        for (int i = 0; i < count; ++i) {
            double from = 2 * pi * (double(i) / count + offset), to = 2 * pi * (double(i + 1) / count + offset);
            regions.push_back({low, high, from, to, on_sphere(0.5 * (low + high), 0.5 * (from + to))});
        }
        above += count;
        before = count;
    }
    regions.push_back({pi - cap, pi, 0, 2 * pi, {0, 0, -1}});
    return regions;
}

std::vector<glm::vec3> ldm_directions(int maps) {
    std::vector<glm::vec3> above, equator;
    for (const ZonalRegion& region : zonal_equal_area_partition(2 * maps)) {
        bool level = std::abs(region.centre.z) < 1e-9;
        if (level)
            equator.emplace_back(region.centre);
        else if (region.centre.z > 0)
            above.emplace_back(region.centre);
    }
    // A ring on the equator holds its own antipodes: one half of it, in the order of longitudes.
    above.insert(above.end(), equator.begin(), equator.begin() + std::ptrdiff_t(equator.size() / 2));
    return above;
}

glm::mat3 tilt_off_axes() {
    return glm::mat3_cast(glm::quat(glm::vec3(0.37f, 0.61f, 0.23f)));
}

glm::mat3 turn_of_frame(int index) {
    if (index == 0) return glm::mat3(1);
    // Shoemake's uniform rotations of three low-discrepancy numbers.
    double u = halton(0, uint64_t(index)), a = 2 * pi * halton(1, uint64_t(index)),
           b = 2 * pi * halton(2, uint64_t(index));
    double p = std::sqrt(1 - u), q = std::sqrt(u);
    return glm::mat3_cast(
        glm::quat(float(q * std::cos(b)), float(p * std::sin(a)), float(p * std::cos(a)), float(q * std::sin(b))));
}

} // namespace bounce
