#pragma once
// A coarse grid of where a scene has surfaces and which way they face: enough to find a view from inside a room
// without a ray tracer.

#include "scene/scene.h"

#include <vector>

namespace bounce {

class OccupancyGrid {
  public:
    /// The scene at time 0; `resolution` cells along the longest edge of its bounds, which leave out strays.
    OccupancyGrid(const Scene& scene, int resolution);

    struct Hit {
        bool escaped = true; ///< left the bounds without meeting a surface
        bool front = false;  ///< the surface's normal is turned toward the ray
        float distance = 0;  ///< metres, to the surface or to the edge of the bounds; a cell's size uncertain
    };
    /// `direction` is unit; `origin` inside the bounds. Surfaces within two cells of the origin are passed over.
    Hit trace(const glm::vec3& origin, const glm::vec3& direction) const;

    bool occupied(const glm::vec3& p) const;
    const Bounds& bounds() const { return bounds_; }
    float cell() const { return cell_; }

  private:
    int cell_index(const glm::vec3& p) const; ///< −1 outside
    void add_inside(const glm::vec3 corners[3], const glm::vec3& normal);
    void add_triangle(const glm::vec3 corners[3], const glm::vec3& normal);

    Bounds bounds_;
    float cell_ = 1;
    glm::ivec3 size_{1};
    std::vector<glm::vec3> normals_; ///< sums; and
    std::vector<char> occupied_;
    size_t points_left_ = 40'000'000; ///< samples of triangles still to be spent
};

} // namespace bounce
