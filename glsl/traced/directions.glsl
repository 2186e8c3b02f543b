#ifndef TRACED_DIRECTIONS_GLSL
#define TRACED_DIRECTIONS_GLSL
// N directions over a hemisphere with the density cosθ/π: cosθ = √(1 − (i + part)/N), a golden angle apart. Neighbours take
// other ones: `part` and a turn about the normal differ from texel to texel.
#include "voxel/cone_set.glsl"

uniform int pattern = 1;    //! {interleave, noise} neighbours differ in blocks of n × n, or by R2 and interleaved gradient noise
uniform int interleave = 4; //! [1, 8] (texels) pattern interleave: n; 1: all take the same
uniform bool vary = false;  //! other directions in each frame, for accumulation

struct Directions {
    float part, turn;
    int count;
};

Directions directions_at(ivec2 texel, int count) {
    Directions set;
    set.count = count;
    float frame = vary ? float(frame_index % 4096) : 0.0;
    if (pattern == 0) {
        set.part = interleaved_part(texel, interleave);
        set.turn = fract(set.part * 1.61803398875 + 0.5);
    } else {
        // R2 (Roberts 2018); interleaved gradient noise (Jimenez 2014).
        set.part = fract(0.7548776662 * float(texel.x) + 0.5698402910 * float(texel.y));
        set.turn = fract(52.9829189 * fract(0.06711056 * float(texel.x) + 0.00583715 * float(texel.y)));
    }
    set.part = fract(set.part + 0.6180339887 * frame);
    set.turn = fract(set.turn + 0.7548776662 * frame);
    return set;
}

// In the frame of the normal (z).
vec3 direction_of(Directions set, int i) {
    float at = (float(i) + set.part) / float(set.count);
    float turn = k_golden_angle * float(i) + 6.28318530718 * set.turn;
    return vec3(sqrt(at) * vec2(cos(turn), sin(turn)), sqrt(1.0 - at));
}

#endif
