#ifndef VOXEL_OCCLUSION_STORE_GLSL
#define VOXEL_OCCLUSION_STORE_GLSL
// Writes occlusion voxels. Every writer of a voxel writes the same value (255), so concurrent writers need no atomics
// (LRSM, section 5). With directional leaves the texture holds six volumes one behind the other, +x −x +y −y +z −z:
// leaf k is set where a surface faces axis k by more than `leaf_threshold`; double-sided materials face both ways.
#ifndef STORE_VOXEL // one byte a voxel; voxel/occlusion_bits.comp brings its own
layout(FORMAT_voxels_occlusion) writeonly uniform image3D voxels_occlusion;
#define STORE_VOXEL(voxel) imageStore(voxels_occlusion, voxel, vec4(1.0))
#define STORED_SLICES(grid_resolution) imageSize(voxels_occlusion).z
#endif

uniform float leaf_threshold = 0.3;  //! [0, 1] directional leaves: the cosine to an axis from which a surface blocks along it

void store_occlusion(ivec3 voxel, vec3 facing, bool both_sides, int grid_resolution) {
    int slices = STORED_SLICES(grid_resolution);
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(grid_resolution)))) return;
    if (slices == grid_resolution) {
        STORE_VOXEL(voxel);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        float cosine = facing[axis];
        if (cosine > leaf_threshold || (both_sides && -cosine > leaf_threshold))
            STORE_VOXEL(voxel + ivec3(0, 0, 2 * axis * grid_resolution));
        if (-cosine > leaf_threshold || (both_sides && cosine > leaf_threshold))
            STORE_VOXEL(voxel + ivec3(0, 0, (2 * axis + 1) * grid_resolution));
    }
}

#endif
