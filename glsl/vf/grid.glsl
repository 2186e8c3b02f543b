#ifndef VF_GRID_GLSL
#define VF_GRID_GLSL
// The cells that hold the point proxies (VF, section 3.1): a box fitted to the scene's bounds, cut into size.x·size.y·size.z
// cells. passes/vf/grid.h mirrors the structs.
#include "lib/cell_grid.glsl"

// 128 bytes in std430.
struct Grid {
    vec3 origin;       // metres
    int overlap;       // 1: discs are found in each cell that they reach into
    vec3 cell;         // sides of a cell, metres
    float disc_radius; // of a proxy that stands for 1/density, metres
    ivec3 size;
    int count;         // of cells
    float area;        // of the scene, m²
    float density;     // proxies per m²
    uint asked;        // proxies that the parameter asks for
    uint used;         // the same, lowered to what the scene needs
    uint proxies;      // that were emitted
    uint dropped;      // for lack of capacity
    uint transparent;  // that fell where alpha cuts the surface away
    uint outside;      // that lie outside of the grid
    uint entries;      // proxies and their copies in neighbouring cells
    uint dropped_entries;
    uint fullest;      // entries of the fullest cell
    uint padding_a;
    uvec4 padding_b, padding_c;
};

// A disc that stands for a part of the surface. 48 bytes.
struct Proxy {
    vec3 position; // metres
    float area;    // m² that it stands for; 0: a copy for a neighbouring cell
    vec3 normal;   // of the triangle, on its authored side
    float radius;  // of the disc, metres
    vec3 albedo;   // ρ
    uint cell;     // in which its position lies
};

// What a proxy sends on as a virtual point light: I = L·A, W/sr along the normal, to the side of the normal and to the other
// one. 32 bytes.
struct ProxyLight {
    vec4 front, back;
};

// A cell's light (Eq. 2–3). 80 bytes.
struct Cell {
    vec4 c00;      // rgb; a: 1 where any proxy is lit
    vec4 c1[3];    // coefficients of Y_1x, Y_1y, Y_1z
    vec4 middle; // of the lit proxies by intensity, metres; w: area of the cell's proxies, m²
};

const uint k_no_cell = 0xffffffffu;
#endif
