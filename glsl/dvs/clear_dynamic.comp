// Clears the dynamic voxels, and only them (DVS, section V.B), so that they can be voxelized anew.
#include "dvs/list.glsl"

layout(local_size_x = 64) in;

layout(r32ui) writeonly uniform uimage3D voxels_place;
layout(r8ui) writeonly uniform uimage3D voxels_flags;
layout(FORMAT_voxels_albedo) writeonly uniform image3D voxels_albedo;
layout(FORMAT_voxels_normal) writeonly uniform image3D voxels_normal;
layout(FORMAT_voxels_emission) writeonly uniform image3D voxels_emission;  //! optional
layout(r32ui) writeonly uniform uimage3D voxels_packed_albedo;             //! optional
layout(r32ui) writeonly uniform uimage3D voxels_packed_normal;             //! optional
layout(r32ui) writeonly uniform uimage3D voxels_packed_emission;           //! optional

uniform int averaging;
uniform float emission_scale;

void main() {
    uint index = listed_index();
    if (index < static_listed || index >= listed) return;
    ivec3 voxel = voxel_of(list[index]);
    imageStore(voxels_place, voxel, uvec4(0u));
    imageStore(voxels_flags, voxel, uvec4(0u));
    imageStore(voxels_albedo, voxel, vec4(0.0));
    imageStore(voxels_normal, voxel, vec4(0.0));
    if (emission_scale > 0.0) imageStore(voxels_emission, voxel, vec4(0.0));
    if (averaging != averaging_average) return;
    imageStore(voxels_packed_albedo, voxel, uvec4(0u));
    imageStore(voxels_packed_normal, voxel, uvec4(0u));
    if (emission_scale > 0.0) imageStore(voxels_packed_emission, voxel, uvec4(0u));
}
