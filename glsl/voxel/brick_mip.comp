// The first mip of voxels that are stored as bits (voxel/occlusion_bits.comp), by the rules of voxel/occlusion_mips.comp.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform usampler3D voxels_bricks;
layout(FORMAT_voxels_occlusion) writeonly uniform image3D voxels_occlusion;

uniform int mip_rule = 0;  //! {mean, along_leaf} bits: how eight voxels become one; along_leaf needs directional leaves

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(voxels_occlusion);
    if (any(greaterThanEqual(at, size))) return;
    uint brick = texelFetch(voxels_bricks, at, 0).r;
    if (mip_rule == mip_rule_along_leaf && size.z != size.x) {
        // A column along the leaf's axis is blocked when either of its two voxels is.
        int axis = at.z / size.x / 2;
        uint folded = brick | brick >> (1 << axis);
        brick = folded & (axis == 0 ? 0x55u : axis == 1 ? 0x33u : 0x0fu);
        imageStore(voxels_occlusion, at, vec4(float(bitCount(brick)) / 4.0));
        return;
    }
    imageStore(voxels_occlusion, at, vec4(float(bitCount(brick)) / 8.0));
}
