// Soft shadows by cones over the directional volumes (DVS, section VIII.C).
#include "dvs/cone.glsl"
#include "voxel/shadow_cone.glsl"
