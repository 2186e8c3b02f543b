// One iteration of the propagation (LPV, section 3.3): each cell takes light from its six neighbours. From a neighbour's centre
// a cell's far face and its four side faces are seen; the flux Φ_f = Ω_f·I(ω_f) through each is sent on from the cell's centre
// by a lobe toward that face, of intensity Φ_f/π. Its sixth face is the neighbour's own.
#include "lpv/grid.glsl"
#include "lpv/light.glsl"

uniform int blocking = 0; //! static {surfels, links, none} what stops light: the geometry volume (published), triangles between cells, or nothing

#if blocking == blocking_surfels
layout(std430) readonly buffer lpv_blocking { vec4 blockers[]; };
#include "lpv/blocking.glsl"
#endif
#if blocking == blocking_links
#include "lpv/links.glsl"
#endif

layout(local_size_x = 64) in;

layout(std430) buffer lpv_light { mat3x4 light[]; }; //! ordered: one half is read and the other written
layout(std430) buffer lpv_sum { mat3x4 sums[]; };    //! ordered: each invocation has its own cell

uniform float strength = 1.0;   //! [0, 4] blocking surfels: factor on what the geometry volume stops
uniform int lobes = 0;          //! static {face, direction} light is sent on toward the face (published), or on the way that it came
uniform bool normalise = false; //! static the fluxes through all faces are scaled to what the cell holds: clamping adds nothing
uniform int power = 1;          //! static [1, 4] faces share a cell's light by this power of the intensity; above 1 with normalise

uniform int iteration;

const float k_pi = 3.14159265359;
// Solid angles of a cell's faces from a neighbour's centre, as published. Their sum over all 30 faces is 4π but for 2·10⁻⁵.
const float k_far = 0.4006696846, k_side = 0.4234413544;

vec3 face_light(mat3x4 from, vec3 direction) {
    vec3 intensity = max(harmonics_of(direction) * from, vec3(0.0));
    vec3 result = intensity;
    for (int i = 1; i < power; ++i)
        result *= intensity;
    return result;
}

// What the cell's faces get together, over what it holds.
vec3 excess(mat3x4 from) {
    vec3 sent = vec3(0.0);
    for (int k = 0; k < 6; ++k) {
        vec3 ahead = vec3(0.0);
        ahead[k >> 1] = (k & 1) == 0 ? 1.0 : -1.0;
        sent += k_far * face_light(from, ahead);
        for (int j = 0; j < 4; ++j) {
            vec3 aside = vec3(0.0);
            aside[((k >> 1) + 1 + (j >> 1)) % 3] = (j & 1) == 0 ? 1.0 : -1.0;
            sent += k_side * face_light(from, (2.0 * ahead + aside) / sqrt(5.0));
        }
    }
    vec3 held = 4.0 * k_pi * k_y0 * vec3(from[0].x, from[1].x, from[2].x);
    return mix(held / max(sent, vec3(1.0e-30)), vec3(0.0), lessThanEqual(sent, vec3(0.0)));
}

// What the cell gets from the neighbour at `at - step`.
mat3x4 from_neighbour(int half_from, int cascade, ivec3 at, ivec3 step, int axis) {
    ivec3 before = at - step;
    if (!in_grid(before, grid_size())) return mat3x4(0.0);
#if blocking == blocking_links
    if (is_blocked(cascade, before, step)) return mat3x4(0.0);
#endif
    mat3x4 source = light[half_from + cascade * cells_of_cascade() + int(cell_index(before, grid_size()))];
    vec3 scale = vec3(1.0), ahead = vec3(step);
    if (normalise) scale = excess(source);
#if blocking == blocking_surfels
    // Not in the first iteration: surfaces would stop the light that they send themselves.
    vec4 blocker = iteration == 0 ? vec4(0.0) : strength * blocker_between(cascade, before, at, axis);
#define OPEN(direction) (1.0 - blocked_share(blocker, direction))
#else
#define OPEN(direction) 1.0
#endif
    mat3x4 sum = lobe_about(ahead, scale * face_light(source, ahead) * (k_far * OPEN(ahead) / k_pi));
    for (int j = 1; j < 3; ++j) {
        mat3x4 both[2];
        for (int side = 0; side < 2; ++side) {
            vec3 aside = vec3(0.0);
            aside[(axis + j) % 3] = side == 0 ? 1.0 : -1.0;
            vec3 direction = (2.0 * ahead + aside) / sqrt(5.0);
            both[side] = lobe_about(lobes == lobes_direction ? direction : aside, scale * face_light(source, direction) * (k_side * OPEN(direction) / k_pi));
        }
        sum += both[0] + both[1];
    }
    return sum;
}

void main() {
    int own = int(gl_GlobalInvocationID.x), count = cells_of_cascade(), all = grid_cascades * count;
    if (own >= all) return;
    int cascade = own / count, from = (iteration & 1) * all, to = all - from;
    ivec3 at = cell_of_index(uint(own % count), grid_size());
    mat3x4 sum = mat3x4(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 step = ivec3(0);
        step[axis] = 1;
        sum += from_neighbour(from, cascade, at, step, axis) + from_neighbour(from, cascade, at, -step, axis);
    }
    light[to + own] = sum;
    sums[own] += sum;
}
