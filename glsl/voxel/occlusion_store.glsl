#ifndef VOXEL_OCCLUSION_STORE_GLSL
#define VOXEL_OCCLUSION_STORE_GLSL
// Writes occlusion voxels. Every writer of a voxel writes the same value (255), so concurrent writers need no atomics
// (LRSM, section 5). With directional leaves the texture holds six volumes one behind the other, +x −x +y −y +z −z:
// leaf k is set where a surface faces axis k by more than `leaf_threshold`; double-sided materials face both ways.
layout(FORMAT_voxels_occlusion) writeonly uniform image3D voxels_occlusion;

uniform float leaf_threshold = 0.3;  //! [0, 1] directional leaves: the cosine to an axis from which a surface blocks along it

void store_occlusion(ivec3 voxel, vec3 facing, bool both_sides, int grid_resolution) {
    ivec3 size = imageSize(voxels_occlusion);
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(grid_resolution)))) return;
    if (size.z == grid_resolution) {
        imageStore(voxels_occlusion, voxel, vec4(1.0));
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        float cosine = facing[axis];
        if (cosine > leaf_threshold || (both_sides && -cosine > leaf_threshold))
            imageStore(voxels_occlusion, voxel + ivec3(0, 0, 2 * axis * grid_resolution), vec4(1.0));
        if (-cosine > leaf_threshold || (both_sides && cosine > leaf_threshold))
            imageStore(voxels_occlusion, voxel + ivec3(0, 0, (2 * axis + 1) * grid_resolution), vec4(1.0));
    }
}

#endif
