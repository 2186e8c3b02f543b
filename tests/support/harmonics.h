#pragma once
// Integrals over the sphere, for tests of spherical harmonics.

#include <cmath>
#include <glm/glm.hpp>

namespace bounce {

/// Real harmonics of l ≤ 1 toward a unit d. m < 0: Y_00; m = 0, 1, 2: Y_1x, Y_1y, Y_1z.
inline double harmonic(int m, glm::dvec3 d) {
    return m < 0 ? std::sqrt(1 / (4 * M_PI)) : std::sqrt(3 / (4 * M_PI)) * d[m];
}

/// The integral of f·Y over the sphere, by a product rule.
template <class F>
double project_on_harmonic(F value, int m) {
    constexpr int k_steps = 400;
    double sum = 0;
    for (int i = 0; i < k_steps; ++i) {
        double z = (i + 0.5) * 2 / k_steps - 1, ring = std::sqrt(1 - z * z);
        for (int j = 0; j < 2 * k_steps; ++j) {
            double phi = (j + 0.5) * M_PI / k_steps;
            glm::dvec3 d(ring * std::cos(phi), ring * std::sin(phi), z);
            sum += value(d) * harmonic(m, d);
        }
    }
    return sum * (2.0 / k_steps) * (M_PI / k_steps);
}

} // namespace bounce
