// The directions of layered depth maps: the partition's areas, count and diameters; one axis a map; turns are
// rotations.
#include "ldm/directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace bounce;

namespace {

using std::numbers::pi;

glm::dvec3 on_sphere(double colatitude, double longitude) {
    return {std::sin(colatitude) * std::cos(longitude), std::sin(colatitude) * std::sin(longitude),
            std::cos(colatitude)};
}
double area(const ZonalRegion& r) {
    return (r.longitude_high - r.longitude_low) * (std::cos(r.colatitude_low) - std::cos(r.colatitude_high));
}
bool is_cap(const ZonalRegion& r) {
    return r.longitude_high - r.longitude_low > 2 * pi - 1e-9;
}
/// Greatest chord, over points along its rim.
double diameter(const ZonalRegion& r) {
    if (is_cap(r)) {
        double reach = r.colatitude_low == 0 ? r.colatitude_high : pi - r.colatitude_low;
        return reach >= pi / 2 ? 2 : 2 * std::sin(reach);
    }
    std::vector<glm::dvec3> rim;
    constexpr int k_parts = 8;
    for (int i = 0; i <= k_parts; ++i) {
        double share = double(i) / k_parts;
        double longitude = std::lerp(r.longitude_low, r.longitude_high, share);
        rim.push_back(on_sphere(r.colatitude_low, longitude));
        rim.push_back(on_sphere(r.colatitude_high, longitude));
        double colatitude = std::lerp(r.colatitude_low, r.colatitude_high, share);
        rim.push_back(on_sphere(colatitude, r.longitude_low));
        rim.push_back(on_sphere(colatitude, r.longitude_high));
    }
    double most = 0;
    for (const glm::dvec3& a : rim)
        for (const glm::dvec3& b : rim)
            most = std::max(most, glm::distance(a, b));
    return most;
}

} // namespace

/// Leopardi 2006, Theorem 2: the diameter is at most 7/√n.
TEST(LdmDirections, RegionsHaveEqualAreasAndSmallDiameters) {
    double widest = 0;
    for (int n : {2, 3, 4, 5, 6, 7, 10, 16, 17, 33, 64, 100, 127, 256, 1024, 2048}) {
        std::vector<ZonalRegion> regions = zonal_equal_area_partition(n);
        ASSERT_EQ(regions.size(), size_t(n));
        for (const ZonalRegion& r : regions) {
            EXPECT_NEAR(area(r) * n / (4 * pi), 1, 1e-6) << n;
            widest = std::max(widest, diameter(r) * std::sqrt(n));
            EXPECT_NEAR(glm::length(r.centre), 1, 1e-12);
        }
    }
    RecordProperty("widest_diameter_times_root_n", std::to_string(widest));
    EXPECT_LE(widest, 7);
    EXPECT_GT(widest, 2); // a disc of this area has 4
}

/// They tile: collars follow one another without gap, and each collar goes once around.
TEST(LdmDirections, RegionsTileTheSphere) {
    for (int n : {2, 3, 5, 16, 129, 1024}) {
        std::vector<ZonalRegion> regions = zonal_equal_area_partition(n);
        EXPECT_EQ(regions.front().colatitude_low, 0);
        EXPECT_NEAR(regions.back().colatitude_high, pi, 1e-12);
        for (size_t i = 1; i < regions.size(); ++i) {
            const ZonalRegion &a = regions[i - 1], &b = regions[i];
            bool same_collar = b.colatitude_low == a.colatitude_low;
            if (same_collar) {
                EXPECT_NEAR(a.longitude_high, b.longitude_low, 1e-9);
            } else {
                EXPECT_NEAR(a.colatitude_high, b.colatitude_low, 1e-9) << n << " region " << i;
            }
        }
        double around = 0, total = 0;
        for (size_t i = 0; i < regions.size(); ++i) {
            around += regions[i].longitude_high - regions[i].longitude_low;
            total += area(regions[i]);
            if (i + 1 == regions.size() || regions[i + 1].colatitude_low != regions[i].colatitude_low) {
                EXPECT_NEAR(around, 2 * pi, 1e-9);
                around = 0;
            }
        }
        EXPECT_NEAR(total, 4 * pi, 1e-9);
    }
}

TEST(LdmDirections, EveryNumberOfMapsHasExactlySoManyAxes) {
    for (int maps = 1; maps <= 4096; ++maps) {
        std::vector<glm::vec3> axes = ldm_directions(maps);
        ASSERT_EQ(axes.size(), size_t(maps));
        for (const glm::vec3& axis : axes) {
            ASSERT_NEAR(glm::length(axis), 1, 1e-6f) << maps;
            ASSERT_GE(axis.z, -1e-6f) << maps;
        }
    }
}

/// No two maps look along one line. The nearest two axes are as far apart as regions are wide.
TEST(LdmDirections, NoAxisTwice) {
    for (int maps : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 16, 25, 32, 37, 64, 100, 128, 255, 256, 257, 512, 1024}) {
        std::vector<glm::vec3> axes = ldm_directions(maps);
        double nearest = 2;
        for (size_t i = 0; i < axes.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                nearest = std::min(nearest, std::min(glm::distance(glm::dvec3(axes[i]), glm::dvec3(axes[j])),
                                                     glm::distance(glm::dvec3(axes[i]), -glm::dvec3(axes[j]))));
        EXPECT_GT(nearest, 0.3 * std::sqrt(4 * pi / (2 * maps))) << maps;
    }
}

/// Eq. 2 for an unoccluded point: 2/N Σ|cosθ| = 1 whichever way the surface faces. This is what unequal areas, a lost
/// or a doubled axis would break.
TEST(LdmDirections, OpenSurfacesAreOpenWhicheverWayTheyFace) {
    // The mean of |cos| over N points: worst over normals, measured .139, .024, .0059, .0017.
    const std::vector<std::pair<int, double>> allowed{{8, 0.16}, {32, 0.03}, {128, 0.008}, {512, 0.0025}};
    for (auto [maps, most] : allowed) {
        std::vector<glm::vec3> axes = ldm_directions(maps);
        double worst = 0;
        for (const ZonalRegion& facing : zonal_equal_area_partition(200)) {
            double sum = 0;
            for (const glm::vec3& axis : axes)
                sum += std::abs(glm::dot(glm::dvec3(axis), facing.centre));
            worst = std::max(worst, std::abs(2 * sum / maps - 1));
        }
        RecordProperty("worst_of_" + std::to_string(maps), std::to_string(worst));
        EXPECT_LT(worst, most) << maps;
    }
}

TEST(LdmDirections, TurnsAreRotations) {
    std::vector<glm::mat3> turns{tilt_off_axes()};
    for (int i = 0; i < 64; ++i)
        turns.push_back(turn_of_frame(i));
    EXPECT_EQ(turns[1], glm::mat3(1));
    for (const glm::mat3& m : turns) {
        glm::mat3 product = m * glm::transpose(m);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(product[i][k], i == k, 2e-6f);
        EXPECT_NEAR(glm::determinant(m), 1, 2e-6f);
    }
    // Each frame's own, and spread over all: the mean of a turned axis is near 0.
    glm::vec3 mean(0);
    for (size_t i = 2; i < turns.size(); ++i) {
        mean += turns[i] * glm::vec3(0, 0, 1) / float(turns.size() - 2);
        for (size_t k = 1; k < i; ++k)
            EXPECT_GT(glm::length(turns[i][0] - turns[k][0]) + glm::length(turns[i][1] - turns[k][1]), 1e-3f);
    }
    EXPECT_LT(glm::length(mean), 0.2f);
    // No map of a common number looks along a world axis when tilted.
    for (int maps : {8, 32, 128}) {
        for (glm::vec3 axis : ldm_directions(maps)) {
            glm::vec3 turned = glm::abs(tilt_off_axes() * axis);
            EXPECT_LT(std::max({turned.x, turned.y, turned.z}), 0.99999f);
        }
    }
}
