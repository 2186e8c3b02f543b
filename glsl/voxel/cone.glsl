#ifndef VOXEL_CONE_GLSL
#define VOXEL_CONE_GLSL
// Occlusion α of a cone's spheres from occlusion voxels (LRSM, section 3.1), between mips and voxels linearly; it is
// gathered front to back (Eq. 1).
// With directional leaves the volume is six volumes one behind the other (voxel/occlusion_store.glsl): the three leaves
// that face the cone are summed with weights |direction_k|, and clamped to 1.
#include "voxel/cone_steps.glsl"

uniform sampler3D voxels_occlusion;
uniform usampler3D voxels_bricks; //! optional
// One bit a voxel instead of a byte (voxel/occlusion_bits.comp): then voxels_occlusion begins with the first mip.
bool occlusion_is_bits() {
    return textureSize(voxels_bricks, 0) == textureSize(voxels_occlusion, 0); // the neutral one has a single texel
}

VoxelGrid cone_grid() {
    ivec3 size = textureSize(voxels_occlusion, 0);
    int leaves = size.z / size.x, finer = occlusion_is_bits() ? 1 : 0;
    // A single voxel of a leaf still shows in four mips of eight bits, one of a mean in two.
    return voxel_grid(size.x << finer, leaves, textureQueryLevels(voxels_occlusion) + finer, leaves == 1 ? 2 : 4);
}

// One voxel of the base level out of its brick.
float brick_bit(ivec3 voxel) {
    uint brick = texelFetch(voxels_bricks, voxel >> 1, 0).r;
    return float(brick >> ((voxel.x & 1) | (voxel.y & 1) << 1 | (voxel.z & 1) << 2) & 1u);
}

// The base level out of bricks, between voxels linearly; `at` in [0, 1]³, `leaf` 0 … 5.
float brick_occlusion(VoxelGrid grid, vec3 at, int leaf) {
    vec3 place = at * float(grid.resolution) - 0.5;
    ivec3 low = ivec3(floor(place));
    vec3 part = place - vec3(low);
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 voxel = clamp(low + corner, ivec3(0), ivec3(grid.resolution - 1));
        voxel.z += leaf * grid.resolution;
        vec3 weight = mix(1.0 - part, part, vec3(corner));
        sum += brick_bit(voxel) * weight.x * weight.y * weight.z;
    }
    return sum;
}

// α of one leaf's volume (or the only one's) at a level, between levels linearly.
float volume_occlusion(VoxelGrid grid, vec3 at, int leaf, float level) {
    float z = at.z;
    if (grid.leaves > 1) {
        // Inside its own volume: half a voxel of the coarser of the two mips away from the next one.
        float margin = 0.5 * exp2(ceil(level)) / float(grid.resolution);
        z = (clamp(z, margin, 1.0 - margin) + float(leaf)) / 6.0;
    }
    if (!occlusion_is_bits()) return textureLod(voxels_occlusion, vec3(at.xy, z), level).r;
    if (level >= 1.0) return textureLod(voxels_occlusion, vec3(at.xy, z), level - 1.0).r;
    float base = brick_occlusion(grid, at, leaf);
    return level <= 0.0 ? base : mix(base, textureLod(voxels_occlusion, vec3(at.xy, z), 0.0).r, level);
}

// α of a sphere, as seen along `direction`; 0 outside the grid.
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    vec3 at = (position - grid.origin) / grid.side;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 0.0;
    float alpha = 0.0;
    if (grid.leaves == 1) {
        alpha = volume_occlusion(grid, at, 0, level);
    } else {
        for (int axis = 0; axis < 3; ++axis) {
            int leaf = 2 * axis + (direction[axis] > 0.0 ? 1 : 0); // a surface that faces −axis blocks what goes along +axis
            alpha += abs(direction[axis]) * volume_occlusion(grid, at, leaf, level);
        }
        alpha = min(alpha, 1.0);
    }
    return corrected_opacity(alpha);
}

#endif
