#pragma once
// Normals and tangents where a file gives none.

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bounce {

/// Gives each triangle three vertices of its own with the triangle's normal and no tangent, as glTF 2.0 §3.7.2.1 asks
/// of primitives without normals. Replaces both arrays; `indices` are into `vertices`.
void make_flat_normals(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices);

/// Whether a normal can be made unit: finite and not zero.
bool usable_normal(const glm::vec3& normal);
/// Whether a vertex has a tangent with handedness: w = 0 and a direction of length 0 say that there is none.
bool has_tangent(const Vertex& vertex);

/// Unit normals; those that are zero or not finite become the area-weighted mean of the vertex' triangles.
/// Returns how many were replaced.
size_t repair_normals(std::span<Vertex> vertices, std::span<const uint32_t> indices);

/// Tangents for the vertices that have none (where only w is missing, only w), along increasing u of the slot's
/// transformed texture coordinates: the mean over the triangles at the vertex and its equals, weighted by their angle,
/// made orthogonal to the normal (Mikkelsen's tangent space, as glTF 2.0 §3.7.2.1 asks). A normal map's green points
/// along −v, since v points down in glTF: w = −1 where (u, v) turn as the triangle does, which is the opposite of what
/// MikkTSpace itself returns. Vertices shared by triangles of both handednesses (mirrored texture) are split; the
/// copies are appended. `indices` are into `vertices`.
void make_tangents(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices, const TextureSlot& slot);

/// Any tangent for those that still have none, or one along the normal.
void finish_tangents(std::span<Vertex> vertices);

/// Any unit vector orthogonal to unit `n`.
glm::vec3 any_orthogonal(const glm::vec3& n);

/// Texture coordinates as `slot` reads them: offset + R(rotation)·(scale·uv), KHR_texture_transform.
glm::vec2 slot_uv(const Vertex& vertex, const TextureSlot& slot);

} // namespace bounce
