#pragma once
// Normals and tangents where a file gives none.

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bounce {

/// Gives each triangle three vertices of its own with the triangle's normal, as glTF 2.0 §3.7.2.1 asks of primitives
/// without normals. Replaces both arrays; `indices` are into `vertices`.
void make_flat_normals(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices);

/// Unit normals; those that are zero or not finite become the area-weighted mean of the vertex' triangles.
/// Returns how many were replaced.
size_t repair_normals(std::span<Vertex> vertices, std::span<const uint32_t> indices);

/// Tangents along increasing u of the slot's transformed texture coordinates: per vertex, the mean over its triangles
/// weighted by their angle at the vertex, made orthogonal to the normal, w = handedness. Vertices shared by triangles
/// of both handednesses (mirrored texture) are split; the copies are appended. `indices` are into `vertices`.
void make_tangents(std::vector<Vertex>& vertices, std::vector<uint32_t>& indices, const TextureSlot& slot);

/// Any unit vector orthogonal to unit `n`.
glm::vec3 any_orthogonal(const glm::vec3& n);

/// Texture coordinates as `slot` reads them: offset + R(rotation)·(scale·uv), KHR_texture_transform.
glm::vec2 slot_uv(const Vertex& vertex, const TextureSlot& slot);

} // namespace bounce
