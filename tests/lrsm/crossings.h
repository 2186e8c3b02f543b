#pragma once
// All that a ray crosses in a scene of one mesh, without any tree: for tests of what rays meet.

#include "scene/scene.h"

#include <algorithm>
#include <vector>

namespace bounce {

struct Crossing {
    double t;
    glm::dvec3 normal, colour;
};

/// The nearest first, up to `length`.
inline std::vector<Crossing> crossings(const Scene& scene, glm::dvec3 origin, glm::dvec3 direction, double length) {
    std::vector<Crossing> found;
    for (const Primitive& primitive : scene.meshes[0].primitives)
        for (uint32_t k = 0; k < primitive.index_count; k += 3) {
            glm::dvec3 corner[3];
            for (uint32_t i = 0; i < 3; ++i)
                corner[i] = scene.vertices[scene.indices[primitive.first_index + k + i]].position;
            glm::dvec3 u = corner[1] - corner[0], v = corner[2] - corner[0], normal = glm::cross(u, v);
            double along = glm::dot(normal, direction);
            if (along == 0) continue;
            double t = glm::dot(normal, corner[0] - origin) / along;
            if (t <= 0 || t >= length) continue;
            glm::dvec3 p = origin + t * direction - corner[0];
            double a = glm::dot(glm::cross(p, v), normal), b = glm::dot(glm::cross(u, p), normal);
            if (a < 0 || b < 0 || a + b > glm::dot(normal, normal)) continue;
            found.push_back(
                {t, glm::normalize(normal), glm::dvec3(scene.materials[size_t(primitive.material)].base_colour)});
        }
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
    return found;
}

} // namespace bounce
