#ifndef SURFACE_SAMPLE_PATTERN_GLSL
#define SURFACE_SAMPLE_PATTERN_GLSL
// How the sample sets of neighbouring texels differ, of every gather: in blocks of n × n that a box as wide averages, or
// by R2 and interleaved gradient noise, whose sets differ most among the nearest neighbours (for an edge-aware filter).
#include "lib/frame.glsl"
#include "lib/interleave.glsl"

uniform int pattern = 0;    //! {interleave, noise} neighbours differ in blocks of n × n, or by R2 and interleaved gradient noise
uniform int interleave = 1; //! [1, 8] (texels) pattern interleave: n, the blocks' width; 1: all take the same
uniform bool vary = false;  //! other samples in each frame, for accumulation

struct SamplePattern {
    float part; // in [0, 1): which of the sets
    float turn; // about the normal, as a share of a full turn
};

SamplePattern pattern_at(ivec2 texel) {
    SamplePattern p;
    if (pattern == pattern_interleave) {
        p.part = interleaved_part(texel, interleave);
        p.turn = fract(p.part * 1.61803398875 + 0.5);
    } else {
        // R2 (Roberts 2018); interleaved gradient noise (Jimenez 2014).
        p.part = fract(0.7548776662 * float(texel.x) + 0.5698402910 * float(texel.y));
        p.turn = fract(52.9829189 * fract(0.06711056 * float(texel.x) + 0.00583715 * float(texel.y)));
    }
    // From frame to frame by the same kind of lattice; in 4096 frames no pair comes twice.
    float frame = vary ? float(frame_index % 4096) : 0.0;
    p.part = fract(p.part + 0.6180339887 * frame);
    p.turn = fract(p.turn + 0.7548776662 * frame);
    return p;
}

#endif
