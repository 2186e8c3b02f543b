#pragma once
// How a node's transform turns normals, and whether it mirrors.

#include <cmath>
#include <glm/glm.hpp>

namespace bounce {

/// Normals turn with the matrix of cofactors, which is the transposed inverse times the determinant and exists for
/// flattening scales too; its length means nothing. `mirrored`: the determinant is negative, so that triangles wind and
/// tangent frames turn the other way around.
struct NormalTransform {
    glm::mat3 matrix{1};
    bool mirrored = false;

    explicit NormalTransform(const glm::mat4& world) {
        // In doubles and scaled: the cofactors and determinants of tiny or huge scales are no floats.
        glm::dmat3 m{glm::mat3(world)};
        double largest = 0;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                largest = std::fmax(largest, std::abs(m[column][row]));
        if (!(largest > 0) || !std::isfinite(largest)) return;
        m *= 1 / largest;
        glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        mirrored = glm::determinant(m) < 0;
        double size = 0;
        for (int column = 0; column < 3; ++column)
            size = std::fmax(size, glm::length(cofactors[column]));
        matrix = size > 0 ? glm::mat3(cofactors * ((mirrored ? -1 : 1) / size)) : glm::mat3(0);
    }
};

} // namespace bounce
