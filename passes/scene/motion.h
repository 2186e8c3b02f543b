#pragma once
// Where moving geometry is over the whole animation.

#include "scene/scene.h"

#include <functional>
#include <vector>

namespace bounce {

/// A part of a moving node's mesh, and the points that stand for it (in the mesh's space).
struct Mover {
    size_t node = 0;
    std::vector<glm::vec3> points;
};

/// The positions of vertices, each once.
std::vector<glm::vec3> points_of(const Scene& scene, std::vector<uint32_t> indices);

inline glm::vec3 world_point(const glm::mat4& world, const glm::vec3& p) {
    return glm::vec3(world[0]) * p.x + glm::vec3(world[1]) * p.y + glm::vec3(world[2]) * p.z + glm::vec3(world[3]);
}

/// Called for each mover and each of `times` moments of the animation (all keys and points between them): the box holds
/// the mover at that moment and on its way there.
using MotionVisitor = std::function<void(size_t mover, const Bounds& box, size_t times)>;
/// Where exactness would cost too much, movers' points are replaced by the corners of their box.
void visit_motion(const Scene& scene, std::vector<Mover>& movers, const MotionVisitor& visit);

} // namespace bounce
