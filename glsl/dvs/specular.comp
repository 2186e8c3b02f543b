// Specular indirect light from the directional volumes (DVS, section VIII.A).
#include "dvs/cone.glsl"
#include "voxel/specular_cone.glsl"
