#pragma once
// Direct light worked out in double precision from the scene's triangles alone: rays against every triangle, and the
// light's formula. It shares no code with the renderer: not the camera's ray, not the falloff, not the G-buffer.

#include "scene/shot.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace bounce {

struct OracleTriangle {
    glm::dvec3 a, b, c, normal; ///< unit normal
    glm::dvec3 albedo;
};

struct OracleHit {
    double t;
    const OracleTriangle* triangle;
};

/// What a pixel should hold.
struct OraclePixel {
    enum class Kind {
        background,
        edge, ///< too near the rim of a triangle, or of a shadow, for a discrete answer
        lit,
        shadowed,
        unlit ///< the light is behind the surface or its cone misses
    } kind = Kind::background;
    glm::dvec3 radiance{0};
    double cosine = 0;
};

class DirectOracle {
  public:
    DirectOracle(const Shot& shot, glm::ivec2 size, int shadow_resolution)
        : state_(evaluate_shot(shot, 0)), size_(size), resolution_(shadow_resolution) {
        for (const Instance& instance : state_.scene.instances) {
            const Material& material = shot.scene.materials[size_t(instance.primitive.material)];
            glm::dvec3 albedo = glm::dvec3(material.base_colour) * (1.0 - material.metallic);
            for (uint32_t i = 0; i + 2 < instance.primitive.index_count; i += 3) {
                std::array<glm::dvec3, 3> p;
                for (uint32_t k = 0; k < 3; ++k) {
                    const Vertex& v = shot.scene.vertices[shot.scene.indices[instance.primitive.first_index + i + k]];
                    p[k] = glm::dvec3(glm::dmat4(instance.world) * glm::dvec4(glm::dvec3(v.position), 1));
                    for (int axis = 0; axis < 3; ++axis) {
                        low_[axis] = std::min(low_[axis], p[k][axis]);
                        high_[axis] = std::max(high_[axis], p[k][axis]);
                    }
                }
                glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
                if (glm::length(normal) > 0) triangles_.push_back({p[0], p[1], p[2], glm::normalize(normal), albedo});
            }
        }
    }

    const std::vector<Light>& lights() const { return state_.scene.lights; }

    /// The one light's radiance toward the camera at a pixel. `texels`: how near to a shadow's rim counts as an edge.
    OraclePixel pixel(int x, int y, const Light& light, double texels) const {
        auto hit = camera_hit(x + 0.5, y + 0.5);
        for (glm::dvec2 jog : {glm::dvec2(-0.05, 0), {0.05, 0}, {0, -0.05}, {0, 0.05}}) {
            auto near = camera_hit(x + 0.5 + jog.x, y + 0.5 + jog.y);
            if (near.has_value() != hit.has_value() || (hit && near->triangle->normal != hit->triangle->normal))
                return {OraclePixel::Kind::edge, glm::dvec3(0), 0};
        }
        if (!hit) return {};
        glm::dvec3 eye(state_.camera.position), p = eye + ray(x + 0.5, y + 0.5) * hit->t;
        glm::dvec3 n = hit->triangle->normal;
        if (glm::dot(n, eye - p) < 0) n = -n;

        OraclePixel out;
        glm::dvec3 l;
        glm::dvec3 irradiance = irradiance_at(light, p, l);
        out.cosine = glm::dot(n, l);
        if (out.cosine <= 0 || irradiance == glm::dvec3(0)) {
            out.kind = std::abs(out.cosine) < 1e-4 ? OraclePixel::Kind::edge : OraclePixel::Kind::unlit;
            return out;
        }
        bool occluded = blocked(light, p, n, p);
        double texel = texel_at(light, p);
        glm::dvec3 u = glm::normalize(glm::cross(l, std::abs(l.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        glm::dvec3 v = glm::cross(l, u);
        for (double radius : {texels, 0.5 * texels}) {
            for (int i = 0; i < 8; ++i) {
                double angle = i * M_PI / 4;
                glm::dvec3 q = p + (u * std::cos(angle) + v * std::sin(angle)) * (radius * texel);
                if (blocked(light, q, n, p) != occluded) {
                    out.kind = OraclePixel::Kind::edge;
                    return out;
                }
            }
        }
        out.kind = occluded ? OraclePixel::Kind::shadowed : OraclePixel::Kind::lit;
        if (!occluded) out.radiance = hit->triangle->albedo / M_PI * irradiance * out.cosine;
        return out;
    }

  private:
    glm::dvec3 ray(double x, double y) const {
        glm::dvec3 forward = glm::normalize(glm::dvec3(state_.camera.target) - glm::dvec3(state_.camera.position));
        glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(state_.camera.up)));
        glm::dvec3 up = glm::cross(right, forward);
        double half = std::tan(0.5 * state_.camera.vfov), aspect = double(size_.x) / size_.y;
        return forward + right * ((2 * x / size_.x - 1) * half * aspect) + up * ((1 - 2 * y / size_.y) * half);
    }

    std::optional<OracleHit> camera_hit(double x, double y) const {
        std::optional<OracleHit> best;
        glm::dvec3 origin(state_.camera.position), direction = ray(x, y);
        for (const OracleTriangle& triangle : triangles_) {
            double t = intersect(triangle, origin, direction);
            if (t > 0 && (!best || t < best->t)) best = OracleHit{t, &triangle};
        }
        return best;
    }

    /// The ray's parameter where it meets the triangle; −1 where it does not.
    static double intersect(const OracleTriangle& s, glm::dvec3 origin, glm::dvec3 direction) {
        glm::dvec3 e1 = s.b - s.a, e2 = s.c - s.a, h = glm::cross(direction, e2);
        double determinant = glm::dot(e1, h);
        if (std::abs(determinant) < 1e-30) return -1;
        glm::dvec3 from = origin - s.a;
        double u = glm::dot(from, h) / determinant;
        glm::dvec3 q = glm::cross(from, e1);
        double v = glm::dot(direction, q) / determinant;
        constexpr double k_slack = 1e-9; // two triangles of one quad leave no gap
        if (u < -k_slack || v < -k_slack || u + v > 1 + k_slack) return -1;
        return glm::dot(e2, q) / determinant;
    }

    /// Whether something stands between the light and the point where the light's ray through q meets the plane of p.
    bool blocked(const Light& light, glm::dvec3 q, glm::dvec3 n, glm::dvec3 p) const {
        glm::dvec3 origin, direction;
        if (light.type == LightType::directional) {
            direction = glm::normalize(glm::dvec3(light.direction));
            origin = q - direction * (4 * glm::length(high_ - low_));
        } else {
            origin = glm::dvec3(light.position);
            direction = q - origin;
        }
        double slope = glm::dot(direction, n);
        if (slope >= 0) return true; // the plane turns away from the light there
        double end = glm::dot(p - origin, n) / slope;
        double scale = glm::length(high_ - low_);
        for (const OracleTriangle& s : triangles_) {
            bool own_plane =
                std::abs(glm::dot(s.normal, n)) > 1 - 1e-9 && std::abs(glm::dot(s.a - p, n)) < 1e-6 * scale;
            if (own_plane) continue;
            double t = intersect(s, origin, direction);
            if (t > 0 && t < end) return true;
        }
        return false;
    }

    /// Width of a shadow-map texel at p, in metres across the light's ray.
    double texel_at(const Light& light, glm::dvec3 p) const {
        if (light.type == LightType::directional) {
            // The map is a square around the bounds as the light sees them: no wider than the diagonal.
            return glm::length(high_ - low_) / resolution_;
        }
        glm::dvec3 to = p - glm::dvec3(light.position);
        if (light.type == LightType::spot)
            return 2 * std::tan(double(light.outer_cone)) / resolution_ * glm::dot(to, glm::dvec3(light.direction));
        return 2.0 / resolution_ * std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)});
    }

    /// W/m² at normal incidence, as KHR_lights_punctual has it.
    static glm::dvec3 irradiance_at(const Light& light, glm::dvec3 p, glm::dvec3& l) {
        glm::dvec3 intensity(light.intensity);
        if (light.type == LightType::directional) {
            l = -glm::normalize(glm::dvec3(light.direction));
            return intensity;
        }
        glm::dvec3 to = glm::dvec3(light.position) - p;
        double distance = glm::length(to);
        l = to / distance;
        if (light.type == LightType::spot) {
            double outer = std::cos(double(light.outer_cone));
            double scale = 1 / std::max(0.001, std::cos(double(light.inner_cone)) - outer);
            double cd = -glm::dot(l, glm::normalize(glm::dvec3(light.direction)));
            double attenuation = std::min(1.0, std::max(0.0, cd * scale - outer * scale));
            intensity *= attenuation * attenuation;
        }
        return intensity / (distance * distance);
    }

    std::vector<OracleTriangle> triangles_;
    glm::dvec3 low_{1e30}, high_{-1e30};
    ShotState state_;
    glm::ivec2 size_;
    int resolution_;
};

} // namespace bounce
