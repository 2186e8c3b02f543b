// Soft shadows by cones over occlusion voxels (Crassin et al. 2011; LRSM, section 6).
#include "voxel/cone.glsl"
#include "voxel/shadow_cone.glsl"
