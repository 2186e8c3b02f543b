#version 460 core
#extension GL_ARB_x : enable
#include "common.glsl"
#include <common.glsl>
layout(local_size_x = 8) in;
uniform sampler2D out_radiance;
layout(FORMAT_a_b) writeonly uniform image2D a_b; /* x */ // y
readonly buffer list_items { uint v[]; };
uniform float s = 1.0; //! [0, 2] help
uniform bool on = true; //! static x
#if on
#define A(x) \
  (x)
#elif 0
#else
uniform int dead = 1; //! x
#endif
/* block
 comment */ void main() {}
