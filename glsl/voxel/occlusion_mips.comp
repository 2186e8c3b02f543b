// One mip step of the occlusion voxels, 8 bits a voxel. mean: the share of occupied voxels, the same for all directions,
// as published. along_leaf (directional leaves): what a leaf's own axis sees, front to back in depth, then averaged over
// the four columns: α = mean(α_near + (1 − α_near)·α_far); it depends on the axis only, so that both leaves of an axis
// differ only by their base level.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D voxels_finer;  //! from voxels.occlusion mip iteration - 1
layout(FORMAT_voxels_coarser) writeonly uniform image3D voxels_coarser;  //! from voxels.occlusion mip iteration

uniform int mip_rule = 0;  //! {mean, along_leaf} how eight voxels become one; along_leaf needs directional leaves

float finer(ivec3 at) {
    return texelFetch(voxels_finer, at, 0).r;
}

void main() {
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    ivec3 size = imageSize(voxels_coarser);
    if (any(greaterThanEqual(voxel, size))) return;
    ivec3 base = 2 * voxel;
    float alpha = 0.0;
    if (mip_rule == mip_rule_mean || size.z == size.x) {
        for (int i = 0; i < 8; ++i)
            alpha += finer(base + ivec3(i & 1, (i >> 1) & 1, i >> 2));
        alpha /= 8.0;
    } else {
        int axis = voxel.z / size.x / 2;
        ivec3 depth = ivec3(axis == 0, axis == 1, axis == 2);
        ivec3 u = depth.zxy, v = depth.yzx;
        for (int i = 0; i < 4; ++i) {
            ivec3 column = base + (i & 1) * u + (i >> 1) * v;
            float near = finer(column), far = finer(column + depth);
            alpha += near + (1.0 - near) * far;
        }
        alpha /= 4.0;
    }
    imageStore(voxels_coarser, voxel, vec4(alpha));
}
