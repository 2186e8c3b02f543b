// Specular indirect light from the layered reflective shadow maps, by cones drawn from the lobe.
#include "lrsm/cone.glsl"
#include "voxel/lobe_cones.glsl"
