#ifndef VF_GRID_GLSL
#define VF_GRID_GLSL
// The cells that hold the point proxies (VF, section 3.1): a box fitted to the scene's bounds, cut into size.x·size.y·size.z
// cells; Eq. 1: H(v) = v.z·D_x·D_y + v.y·D_x + v.x. passes/vf/grid.h mirrors the structs.

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

uint cell_index(ivec3 v, ivec3 size) {
    return uint((v.z * size.y + v.y) * size.x + v.x);
}
ivec3 cell_of_index(uint cell, ivec3 size) {
    int i = int(cell);
    return ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
}
bool in_grid(ivec3 v, ivec3 size) {
    return all(greaterThanEqual(v, ivec3(0))) && all(lessThan(v, size));
}

// Where a ray goes from cell to cell.
struct GridWalk {
    ivec3 at, step;
    vec3 next, delta; // distances to the next wall of each axis, and from wall to wall
    float from, to;   // the ray's stretch in the present cell
    bool inside;
};

GridWalk start_walk(vec3 grid_origin, vec3 cell, ivec3 size, vec3 origin, vec3 direction) {
    GridWalk walk;
    vec3 d = mix(direction, vec3(1.0e-12), lessThan(abs(direction), vec3(1.0e-12)));
    vec3 low = (grid_origin - origin) / d, high = (grid_origin + cell * vec3(size) - origin) / d;
    vec3 near = min(low, high), far = max(low, high);
    walk.from = max(max(near.x, max(near.y, near.z)), 0.0);
    walk.inside = walk.from <= min(far.x, min(far.y, far.z));
    vec3 place = (origin + walk.from * d - grid_origin) / cell;
    walk.at = clamp(ivec3(floor(place)), ivec3(0), size - 1);
    walk.step = ivec3(sign(d));
    walk.delta = abs(cell / d);
    walk.next = (grid_origin + cell * vec3(walk.at + max(walk.step, ivec3(0))) - origin) / d;
    walk.to = min(walk.next.x, min(walk.next.y, walk.next.z));
    return walk;
}

void next_cell(inout GridWalk walk, ivec3 size) {
    int axis = walk.next.x <= walk.next.y && walk.next.x <= walk.next.z ? 0 : (walk.next.y <= walk.next.z ? 1 : 2);
    walk.from = walk.next[axis];
    walk.at[axis] += walk.step[axis];
    walk.next[axis] += walk.delta[axis];
    walk.to = min(walk.next.x, min(walk.next.y, walk.next.z));
    walk.inside = in_grid(walk.at, size);
}
#endif
