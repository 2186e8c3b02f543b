#ifndef SURFACE_RSM_MAPS_GLSL
#define SURFACE_RSM_MAPS_GLSL
// The reflective shadow maps (surface/rsm.frag), for what also works without them.
#include "surface/rsm_views.glsl"

uniform sampler2DArray rsm_radiance; //! optional
uniform sampler2DArray rsm_normal;   //! optional
uniform sampler2DArray rsm_depth;    //! optional

#endif
