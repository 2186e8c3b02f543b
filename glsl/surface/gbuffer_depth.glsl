#ifndef SURFACE_GBUFFER_DEPTH_GLSL
#define SURFACE_GBUFFER_DEPTH_GLSL
// Where the pixels' surfaces are, and which way they are shaded.
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
#endif
