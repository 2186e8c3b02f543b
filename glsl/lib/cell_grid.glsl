#ifndef LIB_CELL_GRID_GLSL
#define LIB_CELL_GRID_GLSL
// A box cut into size.x·size.y·size.z cells, numbered x first (VF, Eq. 1: H(v) = v.z·D_x·D_y + v.y·D_x + v.x), and rays that go
// from cell to cell.

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
