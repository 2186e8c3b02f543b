#include "surface/shadow_views.h"

#include "scene/near_plane.h"

#include <algorithm>
#include <cmath>

namespace bounce {

static glm::mat3 basis_along(glm::vec3 direction) {
    glm::vec3 helper = std::abs(direction.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    glm::vec3 right = glm::normalize(glm::cross(direction, helper));
    return {right, glm::cross(right, direction), direction};
}

/// Infinite perspective with depth = near / distance along the view.
static ShadowView perspective(glm::vec3 origin, const glm::mat3& basis, float half_angle, float near_plane,
                              int resolution) {
    ShadowView view;
    float tangent = std::tan(half_angle);
    view.origin = origin;
    view.direction = basis[2];
    view.near_plane = near_plane;
    view.texel_size = 2 * tangent / float(resolution);
    glm::mat4 projection(0);
    projection[0][0] = projection[1][1] = 1 / tangent;
    projection[3][2] = near_plane;
    projection[2][3] = 1;
    glm::mat4 to_view(glm::transpose(basis));
    to_view[3] = glm::vec4(glm::transpose(basis) * -origin, 1);
    view.view_projection = projection * to_view;
    return view;
}

static ShadowView orthographic(glm::vec3 direction, const Bounds& bounds, int resolution) {
    glm::mat3 basis = basis_along(direction);
    Bounds box;
    for (int corner = 0; corner < 8; ++corner) {
        glm::vec3 p((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                    (corner & 4) ? bounds.max.z : bounds.min.z);
        box.add(glm::transpose(basis) * p);
    }
    // A margin of two texels around, so that filtering at the rim stays inside; square texels.
    float side = std::max({box.size().x, box.size().y, 1e-6f}) * (1 + 4.0f / float(resolution));
    float range = std::max(box.size().z, 1e-6f) * 1.02f;
    glm::vec3 centre = box.centre();
    ShadowView view;
    view.origin = basis * glm::vec3(centre.x, centre.y, centre.z - 0.5f * range);
    view.direction = direction;
    view.range = range;
    view.texel_size = side / float(resolution);
    glm::mat4 projection(1);
    projection[0][0] = projection[1][1] = 2 / side;
    projection[2][2] = -1 / range;
    projection[3][2] = 1;
    glm::mat4 to_view(glm::transpose(basis));
    to_view[3] = glm::vec4(glm::transpose(basis) * -view.origin, 1);
    view.view_projection = projection * to_view;
    return view;
}

std::vector<ShadowView> shadow_views(const std::vector<Light>& lights, const Bounds& bounds, int resolution) {
    std::vector<ShadowView> views;
    float near_plane = smallest_near_plane(bounds.diagonal());
    for (const Light& light : lights) {
        if (light.type == LightType::directional) {
            views.push_back(orthographic(light.direction, bounds, resolution));
        } else if (light.type == LightType::spot) {
            // Half-angles beyond 85° would spread the map too thin; the cone's rim beyond it goes unshadowed.
            float half_angle = std::clamp(light.outer_cone, 0.01f, 1.4835f);
            views.push_back(
                perspective(light.position, basis_along(light.direction), half_angle, near_plane, resolution));
        } else {
            static const glm::vec3 faces[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
            // Slightly wider than a quarter turn, so that filtering near an edge finds texels of the same face.
            float tangent = 1 + 4.0f / float(resolution);
            for (glm::vec3 face : faces) {
                views.push_back(
                    perspective(light.position, basis_along(face), std::atan(tangent), near_plane, resolution));
                views.back().window = 1 / tangent;
            }
        }
    }
    return views;
}

int shadow_view_count(Declaration& d) {
    return int(d.fact(&SceneFacts::spot_lights) + d.fact(&SceneFacts::directional_lights) +
               6 * d.fact(&SceneFacts::point_lights));
}

std::vector<ShadowView> shadow_views(const PassContext& context, int resolution) {
    std::vector<Light> lights;
    for (const GpuLight& packed : context.lights()) {
        Light& light = lights.emplace_back();
        light.type = LightType(packed.type);
        light.position = packed.position;
        light.direction = packed.direction;
        light.outer_cone = std::acos(packed.outer_cone_cos);
    }
    return shadow_views(lights, context.fact(&SceneFacts::bounds_over_animation), resolution);
}

} // namespace bounce
