#pragma once
// Small scenes made in code, for which light transport has closed forms.

#include "scene/shot.h"

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace bounce::test {

constexpr double k_pi_d = 3.14159265358979323846;

class SceneMaker {
  public:
    SceneMaker() {
        shot.name = "test";
        shot.diffuse_only = true;
        shot.width = shot.height = 16;
    }

    int material(const glm::vec3& colour, const glm::vec3& emission = glm::vec3(0), float metallic = 0,
                 float roughness = 1) {
        Material m;
        m.base_colour = glm::vec4(colour, 1);
        m.emission = emission;
        m.metallic = metallic;
        m.roughness = roughness;
        shot.scene.materials.push_back(m);
        return int(shot.scene.materials.size()) - 1;
    }

    /// A mesh of triangles with flat normals; corners in threes. Returns its node.
    int triangles(const std::vector<glm::vec3>& corners, int material) {
        Scene& scene = shot.scene;
        Primitive primitive;
        primitive.first_index = uint32_t(scene.indices.size());
        primitive.index_count = uint32_t(corners.size());
        primitive.material = material;
        for (size_t i = 0; i < corners.size(); ++i) {
            const size_t t = i / 3 * 3;
            Vertex v;
            v.position = corners[i];
            v.normal = glm::normalize(glm::cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t]));
            v.tangent = glm::vec4(glm::normalize(corners[t + 1] - corners[t]), 1);
            scene.indices.push_back(uint32_t(scene.vertices.size()));
            scene.vertices.push_back(v);
        }
        Mesh mesh;
        mesh.primitives.push_back(primitive);
        scene.meshes.push_back(mesh);
        Node node;
        node.mesh = int(scene.meshes.size()) - 1;
        scene.nodes.push_back(node);
        return int(scene.nodes.size()) - 1;
    }

    /// The parallelogram corner, corner + u, corner + u + v, corner + v, with texture coordinates (0,0) … (1,1).
    int quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, int material) {
        const size_t first = shot.scene.vertices.size();
        int node = triangles({corner, corner + u, corner + u + v, corner, corner + u + v, corner + v}, material);
        const float uv[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (size_t i = 0; i < 6; ++i) {
            shot.scene.vertices[first + i].u0 = uv[i][0];
            shot.scene.vertices[first + i].v0 = uv[i][1];
        }
        return node;
    }

    /// A closed axis-aligned box.
    void box(const glm::vec3& low, const glm::vec3& high, int material) {
        const glm::vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
        quad(low, x, y, material);
        quad(low + z, x, y, material);
        quad(low, x, z, material);
        quad(low + y, x, z, material);
        quad(low, y, z, material);
        quad(low + x, y, z, material);
    }

    /// A sphere about the origin in `rows` by 2·rows facets whose centres lie on the radius.
    void sphere(float radius, int rows, int material) {
        std::vector<glm::vec3> corners;
        const float outward = radius / std::cos(float(k_pi_d) / (2 * float(rows)));
        auto point = [&](int i, int j) {
            const float theta = float(k_pi_d) * float(i) / float(rows), phi = float(k_pi_d) * float(j) / float(rows);
            return outward *
                   glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        };
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < 2 * rows; ++j) {
                if (i > 0)
                    for (auto& p : {point(i, j), point(i, j + 1), point(i + 1, j + 1)})
                        corners.push_back(p);
                if (i < rows - 1)
                    for (auto& p : {point(i, j), point(i + 1, j + 1), point(i + 1, j)})
                        corners.push_back(p);
            }
        }
        triangles(corners, material);
    }

    /// The light's node carries position and direction, as a loaded file's would.
    void light(LightType type, const glm::vec3& position, const glm::vec3& direction, float intensity, float inner = 0,
               float outer = 0.7853982f, float radius = 0, float angular_radius = 0) {
        Light l;
        l.type = type;
        l.position = position;
        l.direction = glm::normalize(direction);
        l.intensity = glm::vec3(intensity);
        l.inner_cone = inner;
        l.outer_cone = outer;
        l.radius = radius;
        l.angular_radius = angular_radius;
        shot.scene.lights.push_back(l);
        shot.light_paths.emplace_back();
        Node node;
        node.light = int(shot.scene.lights.size()) - 1;
        node.translation = position;
        // The rotation that takes −Z to the direction.
        const glm::vec3 from(0, 0, -1);
        const float cosine = glm::dot(from, l.direction);
        if (cosine < -0.9999f)
            node.rotation = glm::quat(0, 0, 1, 0);
        else
            node.rotation = glm::normalize(glm::quat(1 + cosine, glm::cross(from, l.direction)));
        shot.scene.nodes.push_back(node);
    }

    void camera(const glm::vec3& position, const glm::vec3& target, float vfov_degrees,
                const glm::vec3& up = glm::vec3(0, 1, 0)) {
        shot.camera.position = position;
        shot.camera.target = target;
        shot.camera.up = up;
        shot.camera.vfov = glm::radians(vfov_degrees);
    }

    Shot shot;
};

/// The share of what leaves a small patch that reaches a parallel rectangle at height h above it, whose corner lies
/// straight above the patch and whose sides are a and b.
inline double corner_form_factor(double a, double b, double h) {
    const double x = a / h, y = b / h;
    return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
            y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
           (2 * k_pi_d);
}

/// Between two equal parallel rectangles with sides a and b, opposite each other at distance h.
inline double plates_form_factor(double a, double b, double h) {
    const double x = a / h, y = b / h;
    return 2 / (k_pi_d * x * y) *
           (0.5 * std::log((1 + x * x) * (1 + y * y) / (1 + x * x + y * y)) +
            x * std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)) +
            y * std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) - x * std::atan(x) - y * std::atan(y));
}

} // namespace bounce::test
