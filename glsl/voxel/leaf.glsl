#ifndef VOXEL_LEAF_GLSL
#define VOXEL_LEAF_GLSL
// Occlusion of single voxels, for views of the grid. With directional leaves the texture holds six volumes one behind the
// other (voxel/occlusion_store.glsl); a leaf that is asked for where there is only one volume is that volume.
uniform sampler3D voxels_occlusion;

uniform int mip = 0;   //! [0, 9] of the voxels; clamped to those there are
uniform int leaf = 0;  //! {any, x, minus_x, y, minus_y, z, minus_z} directional leaves: which; any: the greatest of the six

int view_mip() {
    return clamp(mip, 0, textureQueryLevels(voxels_occlusion) - 1);
}

// Voxels along each side at the mip.
int view_resolution() {
    return textureSize(voxels_occlusion, view_mip()).x;
}

float voxel_alpha(ivec3 voxel) {
    ivec3 size = textureSize(voxels_occlusion, view_mip());
    int leaves = size.z / size.x;
    if (leaves == 1) return texelFetch(voxels_occlusion, voxel, view_mip()).r;
    float alpha = 0.0;
    for (int i = 0; i < leaves; ++i)
        if (leaf == leaf_any || leaf == i + 1) alpha = max(alpha, texelFetch(voxels_occlusion, voxel + ivec3(0, 0, i * size.x), view_mip()).r);
    return alpha;
}

#endif
