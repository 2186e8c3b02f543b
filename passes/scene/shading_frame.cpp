#include "scene/shading_frame.h"

#include <cmath>

namespace bounce {

namespace {

bool usable(const glm::vec3& v) {
    float square = glm::dot(v, v);
    return std::isfinite(square) && square > 1e-30f;
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    return usable(v) ? v / std::sqrt(glm::dot(v, v)) : otherwise;
}

/// In doubles: the edges of far-away or tiny triangles lose their cross product in floats.
glm::dvec3 area_normal(const Vertex& a, const Vertex& b, const Vertex& c) {
    return glm::cross(glm::dvec3(b.position) - glm::dvec3(a.position), glm::dvec3(c.position) - glm::dvec3(a.position));
}

glm::vec3 face_normal(const Vertex& a, const Vertex& b, const Vertex& c) {
    glm::dvec3 n = area_normal(a, b, c);
    double length = glm::length(n);
    return length > 0 && std::isfinite(length) ? glm::vec3(n / length) : glm::vec3(0, 1, 0);
}

float corner_angle(const glm::vec3& at, const glm::vec3& p, const glm::vec3& q) {
    glm::vec3 a = unit_or(p - at, glm::vec3(0)), b = unit_or(q - at, glm::vec3(0));
    return std::acos(glm::clamp(glm::dot(a, b), -1.0f, 1.0f));
}

/// The direction of increasing u on a triangle, and on which side v lies; nothing where the coordinates are degenerate.
struct FaceTangent {
    glm::vec3 direction{0};
    bool mirrored = false;
    bool valid = false;
};

FaceTangent face_tangent(const Vertex& a, const Vertex& b, const Vertex& c, const TextureSlot& slot) {
    glm::vec2 uv0 = slot_uv(a, slot), d1 = slot_uv(b, slot) - uv0, d2 = slot_uv(c, slot) - uv0;
    float area = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(area) > 0) || !std::isfinite(area)) return {};
    glm::vec3 e1 = b.position - a.position, e2 = c.position - a.position;
    glm::vec3 direction = (e1 * d2.y - e2 * d1.y) * (area > 0 ? 1.0f : -1.0f);
    if (!usable(direction)) return {};
    return {glm::normalize(direction), area < 0, true};
}

} // namespace

glm::vec3 any_orthogonal(const glm::vec3& n) {
    glm::vec3 axis = std::abs(n.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

glm::vec2 slot_uv(const Vertex& vertex, const TextureSlot& slot) {
    glm::vec2 uv = slot.scale * (slot.uv_set == 0 ? glm::vec2(vertex.u0, vertex.v0) : glm::vec2(vertex.u1, vertex.v1));
    float s = std::sin(slot.rotation), c = std::cos(slot.rotation);
    return slot.offset + glm::vec2(c * uv.x + s * uv.y, -s * uv.x + c * uv.y);
}

void make_flat_normals(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices) {
    std::vector<Vertex> flat;
    flat.reserve(indices.size());
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]], &c = vertices[indices[i + 2]];
        glm::vec3 normal = face_normal(a, b, c);
        for (const Vertex* corner : {&a, &b, &c}) {
            flat.push_back(*corner);
            flat.back().normal = normal;
            flat.back().tangent = glm::vec4(any_orthogonal(normal), 1);
        }
    }
    indices.resize(flat.size());
    for (size_t i = 0; i < indices.size(); ++i)
        indices[i] = uint32_t(i);
    vertices = std::move(flat);
}

size_t repair_normals(std::span<Vertex> vertices, std::span<const uint32_t> indices) {
    std::vector<bool> bad(vertices.size(), false);
    size_t count = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
        bad[i] = !usable(vertices[i].normal);
        count += bad[i];
        if (!bad[i]) vertices[i].normal /= std::sqrt(glm::dot(vertices[i].normal, vertices[i].normal));
    }
    if (count == 0) return 0;
    std::vector<glm::dvec3> sum(vertices.size(), glm::dvec3(0));
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        glm::dvec3 n = area_normal(vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]);
        for (size_t corner = 0; corner < 3; ++corner)
            if (bad[indices[i + corner]]) sum[indices[i + corner]] += n;
    }
    for (size_t i = 0; i < vertices.size(); ++i) {
        if (!bad[i]) continue;
        double length = glm::length(sum[i]);
        vertices[i].normal = length > 0 && std::isfinite(length) ? glm::vec3(sum[i] / length) : glm::vec3(0, 1, 0);
    }
    return count;
}

void make_tangents(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices, const TextureSlot& slot) {
    size_t original = vertices.size();
    std::vector<glm::vec3> sum[2] = {std::vector<glm::vec3>(original, glm::vec3(0)),
                                     std::vector<glm::vec3>(original, glm::vec3(0))};
    std::vector<char> sides(original, 0); // bit 0: plain triangles use it; bit 1: mirrored ones
    std::vector<char> mirrored(indices.size() / 3, 0);
    for (size_t t = 0; t < mirrored.size(); ++t) {
        const uint32_t* corner = &indices[3 * t];
        FaceTangent face = face_tangent(vertices[corner[0]], vertices[corner[1]], vertices[corner[2]], slot);
        if (!face.valid) continue;
        mirrored[t] = face.mirrored;
        for (int k = 0; k < 3; ++k) {
            const Vertex& v = vertices[corner[k]];
            float angle = corner_angle(v.position, vertices[corner[(k + 1) % 3]].position,
                                       vertices[corner[(k + 2) % 3]].position);
            // Projected first, so that triangles at a steep angle to the normal do not count for more.
            glm::vec3 tangent = face.direction - v.normal * glm::dot(v.normal, face.direction);
            sum[int(face.mirrored)][corner[k]] += unit_or(tangent, glm::vec3(0)) * angle;
            sides[corner[k]] = char(sides[corner[k]] | (face.mirrored ? 2 : 1));
        }
    }

    auto set_tangent = [&](Vertex& v, const glm::vec3& direction, bool flipped) {
        glm::vec3 t = unit_or(direction - v.normal * glm::dot(v.normal, direction), any_orthogonal(v.normal));
        v.tangent = glm::vec4(t, flipped ? -1.0f : 1.0f);
    };
    std::vector<uint32_t> copy(original, 0);
    for (size_t i = 0; i < original; ++i) {
        bool flipped = sides[i] == 2;
        if (sides[i] == 3) {
            copy[i] = uint32_t(vertices.size());
            Vertex twin = vertices[i];
            set_tangent(twin, sum[1][i], true);
            vertices.push_back(twin);
        }
        set_tangent(vertices[i], sum[int(flipped)][i], flipped);
    }
    for (size_t t = 0; t < mirrored.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            if (uint32_t& index = indices[3 * t + k]; mirrored[t] && sides[index] == 3) index = copy[index];
}

} // namespace bounce
