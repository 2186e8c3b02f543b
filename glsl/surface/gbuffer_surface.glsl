#ifndef SURFACE_GBUFFER_SURFACE_GLSL
#define SURFACE_GBUFFER_SURFACE_GLSL
// The same with the planes of their triangles.
#include "surface/gbuffer_depth.glsl"
uniform sampler2D gbuffer_geometric_normal;
#endif
