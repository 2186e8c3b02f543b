#pragma once
// Index lists: strips and fans to plain triangles, and vertices that no triangle uses dropped.

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace bounce {

/// Triangle i of a strip is (i, i+1+i%2, i+2−i%2): every second one is turned over (glTF 2.0 §3.7.2.1). Triangles that
/// name a vertex twice, which only join strips, are left out.
std::vector<uint32_t> triangles_of_strip(const std::vector<uint32_t>& strip);

/// Triangle i of a fan is (i+1, i+2, 0), as glTF orders it.
std::vector<uint32_t> triangles_of_fan(const std::vector<uint32_t>& fan);

/// The vertices that `indices` name, in their order; the indices are renumbered to them. Takes time by the number of
/// indices, not of vertices: many primitives may share one large vertex buffer.
std::vector<Vertex> used_vertices(const std::vector<Vertex>& vertices, std::vector<uint32_t>& indices);

} // namespace bounce
