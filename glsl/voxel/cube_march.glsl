#ifndef VOXEL_CUBE_MARCH_GLSL
#define VOXEL_CUBE_MARCH_GLSL
// Voxels as cubes, from the camera: each pixel's ray walks from voxel to voxel (Amanatides & Woo, "A fast voxel traversal
// algorithm for ray tracing", 1987) to the first that is drawn. The voxel that holds the camera is passed by.
#include "lib/frame.glsl"
#include "lib/voxel_grid.glsl"

uniform float edges = 0.06;       //! [0, 0.5] (voxels) width of the dark lines along the cubes' edges

const vec3 k_cube_background = vec3(0.02, 0.022, 0.026);

struct CubeHit {
    ivec3 voxel;
    float distance; // metres; 0: none
    float light;    // by the face that the ray enters
};

// From blue over green to red.
vec3 heat_colour(float heat) {
    return clamp(vec3(2.0 * heat - 0.6, 1.4 - 2.4 * abs(heat - 0.5), 1.2 - 2.0 * heat), 0.1, 1.0);
}

bool cube_is_drawn(ivec3 voxel);

// In a grid of `side` voxels of the mip, the base level having `base_side`.
CubeHit march_cubes(ivec2 pixel, int side, int base_side) {
    CubeHit hit = CubeHit(ivec3(0), 0.0, 0.0);
    vec3 ray = normalize(pixel_ray(vec2(pixel)));
    float metres = voxel_grid_side(base_side) / float(side); // a voxel of the mip
    vec3 from = (camera_position - voxel_grid_origin(metres * float(side))) / metres;

    // Into the grid, in voxel units; a direction component of 0 never crosses a border.
    vec3 inverse = 1.0 / mix(ray, vec3(1.0e-20), lessThan(abs(ray), vec3(1.0e-20)));
    vec3 to_low = -from * inverse, to_high = (float(side) - from) * inverse;
    vec3 near = min(to_low, to_high), far = max(to_low, to_high);
    float t = max(max(near.x, near.y), near.z), end = min(min(far.x, far.y), far.z);
    int axis = t == near.x ? 0 : (t == near.y ? 1 : 2);
    bool inside = t <= 0.0;
    t = max(t, 0.0);
    if (end <= t) return hit;

    ivec3 voxel = clamp(ivec3(floor(from + t * ray)), ivec3(0), ivec3(side - 1));
    ivec3 step = ivec3(sign(inverse));
    vec3 next = (vec3(voxel) + max(vec3(step), 0.0) - from) * inverse;
    for (int i = 0; i < 3 * side; ++i) {
        if (!inside && cube_is_drawn(voxel)) {
            vec3 at = from + t * ray - vec3(voxel);
            vec2 on_face = axis == 0 ? at.yz : (axis == 1 ? at.zx : at.xy);
            vec2 inward = min(on_face, 1.0 - on_face);
            float light = axis == 1 ? (step.y < 0 ? 1.0 : 0.2) : (axis == 0 ? 0.6 : 0.4);
            float pixels = float(resolution.y) / (2.0 * tan_half_vfov * max(t, 1.0e-6)); // that a voxel covers
            if (min(inward.x, inward.y) < edges) light *= 1.0 - 0.5 * smoothstep(4.0, 12.0, pixels); // else they flicker
            return CubeHit(voxel, t * metres, light);
        }
        inside = false;
        axis = next.x <= next.y && next.x <= next.z ? 0 : (next.y <= next.z ? 1 : 2);
        t = next[axis];
        voxel[axis] += step[axis];
        next[axis] += abs(inverse[axis]);
        if (voxel[axis] < 0 || voxel[axis] >= side) return hit;
    }
    return hit;
}

#endif
