// Specular indirect light from the layered reflective shadow maps (LRSM, section 5).
#include "lrsm/cone.glsl"
#include "voxel/specular_cone.glsl"
