#include "reference/emitters.h"

namespace bounce {

Emitters::Emitters(const TraceGeometry& geometry) {
    std::vector<float> weights;
    for (uint32_t g = 0; g < geometry.geometries().size(); ++g) {
        const TraceGeometry::Geometry& mesh = geometry.geometries()[g];
        const float largest = luminance(geometry.largest_emission(mesh));
        if (!geometry.emissive(mesh) || !(largest > 0)) {
            first_.push_back(~0u);
            continue;
        }
        first_.push_back(uint32_t(triangles_.size()));
        for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            // The mean is an estimate: a floor keeps every triangle that may emit within reach.
            float mean = std::max(luminance(geometry.mean_emission(mesh, t)), 0.02f * largest);
            weights.push_back(0.5f * glm::length(triangle_cross(mesh, t)) * mean);
            triangles_.push_back({g, t});
        }
    }
    table_ = WeightedTable(weights);
}

static float solid_angle_density(float area_density, float distance_squared, float cosine) {
    return cosine > 1e-7f ? area_density * distance_squared / cosine : 0.0f;
}

Emitters::Sample Emitters::sample(const TraceGeometry& geometry, const Place& from, float choice,
                                  const glm::vec2& u) const {
    Sample sample;
    const size_t i = table_.draw(choice);
    const Triangle& triangle = triangles_[i];
    const TraceGeometry::Geometry& mesh = geometry.geometries()[triangle.geometry];
    const float root = std::sqrt(u.x), b = root * (1 - u.y), c = root * u.y;
    const uint32_t* index = &mesh.indices[size_t(triangle.triangle) * 3];
    const glm::vec3 &p0 = mesh.vertices[index[0]].position, &p1 = mesh.vertices[index[1]].position,
                    &p2 = mesh.vertices[index[2]].position;
    const glm::vec3 edge1 = p1 - p0, edge2 = p2 - p0;
    const Place point = place_on(p0, edge1, edge2, b, c);
    const glm::vec3 across = glm::cross(edge1, edge2);
    const float twice_area = glm::length(across);
    glm::vec3 normal = across / twice_area;
    const glm::vec3 to_point = from.to(point);
    const float distance_squared = glm::dot(to_point, to_point);
    if (!(distance_squared > 0) || !(twice_area > 0)) return sample;
    sample.direction = to_point / std::sqrt(distance_squared);
    if (glm::dot(normal, sample.direction) > 0) normal = -normal;
    sample.density = solid_angle_density(table_.probability(i) / (0.5f * twice_area), distance_squared,
                                         -glm::dot(normal, sample.direction));
    if (sample.density <= 0) return sample;
    // Where a ray from afar meets the triangle is known as well as what leads from there to its corners.
    const float from_afar = 16 * k_float_rounding * glm::dot(glm::abs(normal), glm::abs(to_point));
    sample.position = point.position() + (safe_offset(point, edge1, edge2, normal) + from_afar) * normal;
    sample.radiance = geometry.expected_emission(mesh, triangle.triangle, b, c);
    return sample;
}

float Emitters::density(const TraceGeometry& geometry, const Place& from, const Hit& hit,
                        const glm::vec3& ray_direction) const {
    if (empty() || first_[hit.geometry] == ~0u) return 0;
    const TraceGeometry::Geometry& mesh = geometry.geometries()[hit.geometry];
    const glm::vec3 across = triangle_cross(mesh, hit.triangle);
    const float twice_area = glm::length(across);
    if (!(twice_area > 0)) return 0;
    const float cosine = std::abs(glm::dot(across, ray_direction)) / twice_area;
    // Seen from the surface and not from the ray's origin, as `sample` does.
    const glm::vec3 to_point = from.to(geometry.place(hit));
    return solid_angle_density(table_.probability(first_[hit.geometry] + hit.triangle) / (0.5f * twice_area),
                               glm::dot(to_point, to_point), cosine);
}

} // namespace bounce
