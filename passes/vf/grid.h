#pragma once
// std430 mirrors of glsl/vf/grid.glsl.

#include <cstdint>
#include <glm/glm.hpp>

namespace bounce {

/// The cells that hold the point proxies, and what was counted while they were filled.
struct VfGrid {
    glm::vec3 origin;     ///< metres
    int32_t overlap;      ///< 1: discs are found in each cell that they reach into
    glm::vec3 cell;       ///< sides of a cell, metres
    float disc_radius;    ///< of a proxy that stands for 1/density, metres
    glm::ivec3 size;      ///< cells along x, y, z
    int32_t count;        ///< of cells
    float area;           ///< of the scene, m²
    float density;        ///< proxies per m²
    uint32_t asked;       ///< proxies that the parameter asks for
    uint32_t used;        ///< the same, lowered to what the scene needs
    uint32_t proxies;     ///< that were emitted
    uint32_t dropped;     ///< for lack of capacity
    uint32_t cut_away;    ///< that fell where alpha cuts the surface away
    uint32_t outside;     ///< that lie outside of the grid
    uint32_t entries;     ///< proxies and their copies in neighbouring cells
    uint32_t lost_copies; ///< entries dropped for lack of capacity
    uint32_t fullest;     ///< entries of the fullest cell
    uint32_t padding[9];
};
static_assert(sizeof(VfGrid) == 128);

/// A disc that stands for a part of the surface.
struct VfProxy {
    glm::vec3 position; ///< metres
    float area;         ///< m² that it stands for; 0: a copy for a neighbouring cell
    glm::vec3 normal;   ///< of the triangle, on its authored side
    float radius;       ///< of the disc, metres
    glm::vec3 albedo;   ///< ρ
    uint32_t cell;      ///< in which its position lies
};
static_assert(sizeof(VfProxy) == 48);
inline constexpr uint32_t k_no_vf_cell = 0xffffffffu;

/// What a proxy sends on to both of its sides: L·A, W/sr along the normal.
struct VfProxyLight {
    glm::vec4 front, back;
};

/// A cell's light (Eq. 2–3 of the paper) in real spherical harmonics.
struct VfCell {
    glm::vec4 c00;    ///< a: 1 where any proxy is lit
    glm::vec4 c1[3];  ///< of Y_1x, Y_1y, Y_1z
    glm::vec4 middle; ///< of the lit proxies by intensity, metres; w: area of the cell's proxies, m²
};
static_assert(sizeof(VfCell) == 80);

} // namespace bounce
