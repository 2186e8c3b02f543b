// Specular indirect light from the radiance of voxels, by cones drawn from the lobe.
#include "dvs/cone.glsl"
#include "voxel/lobe_cones.glsl"
