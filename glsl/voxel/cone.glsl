#ifndef VOXEL_CONE_GLSL
#define VOXEL_CONE_GLSL
// Cones over occlusion voxels (Crassin et al. 2011; LRSM, section 3.1): a cone is a row of spheres; the sphere at distance
// t has diameter d = 2·t·tan(θ/2), at least a voxel, and is looked up at mip log2(d/voxel), between mips and voxels
// linearly. Occlusion α is gathered front to back (Eq. 1).
// With directional leaves the volume is six volumes one behind the other (voxel/occlusion_store.glsl): the three leaves
// that face the cone are summed with weights |direction_k|, and clamped to 1.
#ifndef SEE_STEP // what a view of the cones is told of each step toward a hit
#define SEE_STEP(centre, t, diameter, alpha, level)
#endif
#include "lib/voxel_grid.glsl"

uniform sampler3D voxels_occlusion;
uniform usampler3D voxels_bricks; //! optional
// One bit a voxel instead of a byte (voxel/occlusion_bits.comp): then voxels_occlusion begins with the first mip.

uniform float cone_step = 0.5;         //! [0.05, 2] the step from sphere to sphere as a share of their diameter (β)
uniform float start_offset = 1.0;      //! [0, 16] (voxels) how far along the cone the first sphere lies
uniform float normal_offset = 1.0;     //! [0, 16] (voxels) how far the apex is moved along the surface's normal
uniform float opacity_exponent = 1.0;  //! [0.1, 2] α' = 1 − (1 − α)^e for each sphere: 1 as published
uniform int most_steps = 128;          //! [1, 512] spheres a cone, at most
uniform float reach = 1.0;             //! [0.01, 2] how far cones go, as a share of the scene's diagonal

struct VoxelGrid {
    vec3 origin; // metres
    float side;
    float voxel; // metres
    int resolution;
    int leaves; // 1, or 6
    bool bits;  // the base level is voxels_bricks
};

VoxelGrid occlusion_grid() {
    ivec3 size = textureSize(voxels_occlusion, 0);
    VoxelGrid grid;
    grid.bits = textureSize(voxels_bricks, 0) == size; // the neutral one has a single texel
    grid.resolution = grid.bits ? 2 * size.x : size.x;
    grid.leaves = size.z / size.x;
    grid.side = voxel_grid_side(grid.resolution);
    grid.origin = voxel_grid_origin(grid.side);
    grid.voxel = grid.side / float(grid.resolution);
    return grid;
}

int coarsest_level(VoxelGrid grid) {
    return textureQueryLevels(voxels_occlusion) - (grid.bits ? 0 : 1);
}

float sphere_level(VoxelGrid grid, float diameter) {
    return clamp(log2(max(diameter / grid.voxel, 1.0)), 0.0, float(coarsest_level(grid)));
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
        uint brick = texelFetch(voxels_bricks, voxel >> 1, 0).r;
        vec3 weight = mix(1.0 - part, part, vec3(corner));
        if ((brick >> ((voxel.x & 1) | (voxel.y & 1) << 1 | (voxel.z & 1) << 2) & 1u) != 0u) sum += weight.x * weight.y * weight.z;
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
    if (!grid.bits) return textureLod(voxels_occlusion, vec3(at.xy, z), level).r;
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
    return opacity_exponent == 1.0 ? alpha : 1.0 - pow(1.0 - alpha, opacity_exponent);
}

// Where a thin cone is blocked: the distance at which its occlusion passes `threshold`; below 0: it is not. Steps of
// cone_step·d, d = diameter·t, at least a voxel. Empty space is crossed by coarser mips: where the eight texels around a
// point are empty, nothing lies within half a texel of it. (A single voxel of a leaf still shows in four mips of eight
// bits, one of a mean in two.)
float find_hit(VoxelGrid grid, vec3 apex, vec3 direction, float diameter, float threshold) {
    float t = max(start_offset, 1.0e-3) * grid.voxel, end = reach * scene_diagonal;
    float open = 1.0;
    int coarsest = min(grid.leaves == 1 ? 2 : 4, coarsest_level(grid)), skip = coarsest;
    for (int i = 0; i < most_steps && t < end; ++i) {
        vec3 centre = apex + t * direction;
        if (any(lessThan(centre, grid.origin)) || any(greaterThan(centre, grid.origin + grid.side))) return -1.0;
        float d = max(diameter * t, grid.voxel), level = sphere_level(grid, d);
        float alpha = sphere_occlusion(grid, centre, direction, max(level, float(skip)));
        SEE_STEP(centre, t, max(d, exp2(float(skip)) * grid.voxel), alpha, max(level, float(skip)));
        if (float(skip) > level) {
            if (alpha <= 0.0) {
                t += 0.5 * exp2(float(skip)) * grid.voxel;
                skip = min(skip + 1, coarsest);
            } else {
                --skip;
            }
            continue;
        }
        open *= 1.0 - alpha;
        if (1.0 - open >= threshold) return t;
        t += cone_step * d;
        if (alpha <= 0.0) skip = min(skip + 1, coarsest);
    }
    return -1.0;
}

#endif
