#include "scene/shading_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace bounce {

namespace {

/// In doubles: the squares of very short and very long vectors are no floats.
glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    double length = glm::length(glm::dvec3(v));
    return std::isfinite(length) && length > 1e-30 ? glm::vec3(glm::dvec3(v) / length) : otherwise;
}

bool usable(const glm::vec3& v) {
    return unit_or(v, glm::vec3(0)) != glm::vec3(0);
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

/// The direction of increasing u on a triangle, and whether −v lies on the other side of it than n × u does; nothing
/// where the coordinates are degenerate.
struct FaceTangent {
    glm::vec3 direction{0};
    bool left_handed = false;
    bool valid = false;
};

FaceTangent face_tangent(const Vertex& a, const Vertex& b, const Vertex& c, const TextureSlot& slot) {
    // In doubles: products of small coordinates are no floats.
    glm::dvec2 uv0 = slot_uv(a, slot), d1 = glm::dvec2(slot_uv(b, slot)) - uv0, d2 = glm::dvec2(slot_uv(c, slot)) - uv0;
    double area = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(area) > 0) || !std::isfinite(area)) return {};
    glm::dvec3 e1 = glm::dvec3(b.position) - glm::dvec3(a.position);
    glm::dvec3 e2 = glm::dvec3(c.position) - glm::dvec3(a.position);
    glm::dvec3 direction = (e1 * d2.y - e2 * d1.y) * (area > 0 ? 1.0 : -1.0);
    double length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) return {};
    return {glm::vec3(direction / length), area > 0, true};
}

/// For each vertex the first one of the same position, normal and texture coordinates: they shade as one.
std::vector<uint32_t> first_equals(const std::vector<Vertex>& vertices, const TextureSlot& slot) {
    using Key = std::array<uint32_t, 8>; // bits, by which even NaNs have an order
    std::vector<Key> keys;
    keys.reserve(vertices.size());
    for (const Vertex& v : vertices) {
        glm::vec2 uv = slot_uv(v, slot);
        const float values[] = {v.position.x, v.position.y, v.position.z, v.normal.x,
                                v.normal.y,   v.normal.z,   uv.x,         uv.y};
        Key& key = keys.emplace_back();
        for (size_t k = 0; k < key.size(); ++k)
            key[k] = std::bit_cast<uint32_t>(values[k] + 0.0f); // −0 is 0
    }
    std::vector<uint32_t> order(vertices.size()), first(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? first[order[i - 1]] : order[i];
    return first;
}

} // namespace

bool usable_normal(const glm::vec3& normal) {
    return usable(normal);
}

bool has_tangent(const Vertex& vertex) {
    return usable(glm::vec3(vertex.tangent)) && (vertex.tangent.w == 1 || vertex.tangent.w == -1);
}

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
            flat.back().tangent = glm::vec4(0);
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
        vertices[i].normal = unit_or(vertices[i].normal, glm::vec3(0));
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
    std::vector<uint32_t> first = first_equals(vertices, slot);
    std::vector<glm::vec3> sum[2] = {std::vector<glm::vec3>(original, glm::vec3(0)),
                                     std::vector<glm::vec3>(original, glm::vec3(0))}; // right-handed, left-handed
    std::vector<char> hands(original, 0); // bit 0: right-handed triangles use it; bit 1: left-handed ones
    std::vector<char> left_handed(indices.size() / 3, 0);
    for (size_t t = 0; t < left_handed.size(); ++t) {
        const uint32_t* corner = &indices[3 * t];
        FaceTangent face = face_tangent(vertices[corner[0]], vertices[corner[1]], vertices[corner[2]], slot);
        if (!face.valid) continue;
        left_handed[t] = face.left_handed;
        for (int k = 0; k < 3; ++k) {
            const Vertex& v = vertices[corner[k]];
            float angle = corner_angle(v.position, vertices[corner[(k + 1) % 3]].position,
                                       vertices[corner[(k + 2) % 3]].position);
            // Projected first, so that triangles at a steep angle to the normal do not count for more.
            glm::vec3 tangent = face.direction - v.normal * glm::dot(v.normal, face.direction);
            sum[int(face.left_handed)][first[corner[k]]] += unit_or(tangent, glm::vec3(0)) * angle;
            hands[corner[k]] = char(hands[corner[k]] | (face.left_handed ? 2 : 1));
        }
    }

    auto set_tangent = [&](Vertex& v, const glm::vec3& direction, bool left) {
        glm::vec3 authored(v.tangent), t = usable(authored) ? authored : direction;
        t = unit_or(t - v.normal * glm::dot(v.normal, t), any_orthogonal(v.normal));
        v.tangent = glm::vec4(t, left ? -1.0f : 1.0f);
    };
    std::vector<uint32_t> copy(original, 0);
    for (size_t i = 0; i < original; ++i) {
        if (has_tangent(vertices[i])) continue;
        bool left = hands[i] == 2;
        if (hands[i] == 3) {
            copy[i] = uint32_t(vertices.size());
            Vertex twin = vertices[i];
            set_tangent(twin, sum[1][first[i]], true);
            vertices.push_back(twin);
        }
        set_tangent(vertices[i], sum[int(left)][first[i]], left);
    }
    for (size_t t = 0; t < left_handed.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            if (uint32_t& index = indices[3 * t + k]; left_handed[t] && copy[index] > 0) index = copy[index];
}

void finish_tangents(std::span<Vertex> vertices) {
    for (Vertex& v : vertices) {
        glm::vec3 t(v.tangent);
        glm::vec3 across = t - v.normal * glm::dot(v.normal, t);
        if (!(glm::length(across) > 1e-6f)) t = any_orthogonal(v.normal);
        v.tangent = glm::vec4(t, v.tangent.w < 0 ? -1.0f : 1.0f);
    }
}

} // namespace bounce
