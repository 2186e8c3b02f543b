#ifndef VOXEL_CONE_SET_GLSL
#define VOXEL_CONE_SET_GLSL
// Sets of cones over a hemisphere. six: one along the normal and five around it, tilted by 60°, weights π/4 and 3π/20, as
// usual and as published; six_tilted: the ring at 52.2° (cos² = 3/8), whose quadrature is far better; spiral: N cones of
// equal weight at cosθ = √(1 − (i + ½)/N), a golden angle apart; four: four of equal weight, tilted by 45° (the per-voxel
// bounce of DVS).
// Neighbouring pixels may take different sets (interleaved sampling, Keller & Heidrich 2001; Segovia et al. 2006):
// `part` in [0, 1) says which of them. Spirals then take the N cones whose (i + part)/N interleave, and turn by `turn` (a
// share of a full turn); sixes turn by their part.
#include "lib/interleave.glsl"

// The parameters `cone_set` list them in this order.
const int k_cones_six = 0, k_cones_six_tilted = 1, k_cones_spiral = 2, k_cones_four = 3;

const float k_golden_angle = 2.39996322973;

// A frame around n without branches (Duff et al., "Building an orthonormal basis, revisited", JCGT 2017). Columns: t, b, n.
mat3 frame_around(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

int cone_count(int set, int spiral_cones) {
    return set == k_cones_spiral ? spiral_cones : (set == k_cones_four ? 4 : 6);
}

// The turn that goes with the part of an interleave.
float turn_of_part(float part) {
    return fract(part * 1.61803398875 + 0.5);
}

// Direction of cone i in the frame of the normal, and in w its weight; the weights sum to 1.
vec4 cone_of(int set, int spiral_cones, int i, float part, float turn_share) {
    if (set == k_cones_spiral) {
        float at = (float(i) + part) / float(spiral_cones);
        float cosine = sqrt(1.0 - at), sine = sqrt(at);
        float turn = k_golden_angle * float(i) + 6.28318530718 * turn_share;
        return vec4(sine * cos(turn), sine * sin(turn), cosine, 1.0 / float(spiral_cones));
    }
    if (set == k_cones_four) {
        float turn = 1.57079632679 * (float(i) + part);
        return vec4(0.70710678 * cos(turn), 0.70710678 * sin(turn), 0.70710678, 0.25);
    }
    if (i == 0) return vec4(0.0, 0.0, 1.0, 0.25);
    float tilt = set == k_cones_six ? 1.0471975512 : 0.9117382909; // acos √(3/8)
    float turn = 1.25663706144 * (float(i - 1) + part - 0.5);
    return vec4(sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt), 0.15);
}

vec4 cone_of(int set, int spiral_cones, int i, float part) {
    return cone_of(set, spiral_cones, i, part, turn_of_part(part));
}

#endif
