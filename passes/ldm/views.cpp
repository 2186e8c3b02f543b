#include "ldm/views.h"

#include <algorithm>
#include <cmath>

namespace bounce {

LdmView ldm_view(glm::vec3 direction, const Bounds& bounds, int resolution) {
    glm::vec3 helper = std::abs(direction.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    glm::vec3 right = glm::normalize(glm::cross(direction, helper));
    glm::mat3 basis(right, glm::cross(right, direction), direction);
    Bounds box;
    for (int corner = 0; corner < 8; ++corner) {
        glm::vec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                    (corner & 4) ? bounds.max.z : bounds.min.z);
        box.add(glm::transpose(basis) * p);
    }
    // A flat scene still has a depth; a hundredth of a texel around, so that what lies on the box's sides is inside.
    glm::vec3 size = glm::max(box.size(), glm::vec3(1e-4f * std::max(bounds.diagonal(), 1e-6f)));
    glm::vec3 centre = box.centre();
    LdmView view;
    view.direction = direction;
    view.range = size.z * 1.002f;
    view.texel = glm::vec2(size) * ((1 + 0.02f / float(resolution)) / float(resolution));
    auto row = [&](int axis, float unit, float middle) {
        return glm::vec4(basis[axis] / unit, middle - centre[axis] / unit);
    };
    view.to_x = row(0, view.texel.x, 0.5f * float(resolution));
    view.to_y = row(1, view.texel.y, 0.5f * float(resolution));
    view.to_z = row(2, view.range, 0.5f);
    return view;
}

} // namespace bounce
