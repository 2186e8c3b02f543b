#ifndef SURFACE_RSM_VIEWS_GLSL
#define SURFACE_RSM_VIEWS_GLSL
// Where the reflective shadow maps were taken from: layer i of their arrays is views[i].
#include "lib/shadow.glsl"

layout(std430) readonly buffer rsm_views { ShadowView views[]; }; //! optional

#endif
