#ifndef VOXEL_CONE_STEPS_GLSL
#define VOXEL_CONE_STEPS_GLSL
// How cones walk through voxels (Crassin et al. 2011; LRSM, section 3.1; DVS, section VIII): a cone is a row of spheres; the
// sphere at distance t has diameter d = 2·t·tan(θ/2), at least a voxel, and is looked up at mip log2(d/voxel); the next one
// lies cone_step·d farther. What a sphere's occlusion is, the cone source says.
#ifndef SEE_STEP // what a view of the cones is told of each step toward a hit
#define SEE_STEP(centre, t, diameter, alpha, level)
#endif
#include "voxel/cone_source.glsl"

uniform float cone_step = 0.5;         //! [0.05, 2] the step from sphere to sphere as a share of their diameter (β)
uniform float start_offset = 1.0;      //! [0, 16] (voxels) how far along the cone the first sphere lies
uniform float normal_offset = 1.0;     //! [0, 16] (voxels) how far the apex is moved along the surface's normal
uniform float opacity_exponent = 1.0;  //! [0.1, 2] α' = 1 − (1 − α)^e for each sphere: 1 as published
uniform int max_steps = 128;          //! [1, 512] spheres a cone, at most
uniform float reach = 1.0;             //! [0.01, 2] how far cones go, as a share of the scene's diagonal

VoxelGrid voxel_grid(int grid_resolution, int leaves, int mips, int skip_mips) {
    VoxelGrid grid;
    grid.resolution = grid_resolution;
    grid.leaves = leaves;
    grid.side = voxel_grid_side(grid_resolution);
    grid.origin = voxel_grid_origin(grid.side);
    grid.voxel = grid.side / float(grid_resolution);
    grid.mips = mips;
    grid.skip_mips = min(skip_mips, mips - 1);
    return grid;
}

ConeStart cone_start(VoxelGrid grid, vec3 surface, vec3 face) {
    return ConeStart(surface, face, surface + normal_offset * grid.voxel * face);
}

bool outside_grid(VoxelGrid grid, vec3 position) {
    return any(lessThan(position, grid.origin)) || any(greaterThan(position, grid.origin + grid.side));
}

float sphere_level(VoxelGrid grid, float diameter) {
    return clamp(log2(max(diameter / grid.voxel, 1.0)), 0.0, float(grid.mips - 1));
}

// α' = 1 − (1 − α)^e
float corrected_opacity(float alpha) {
    return opacity_exponent == 1.0 ? alpha : 1.0 - pow(1.0 - alpha, opacity_exponent);
}

// Where a thin cone is blocked: the distance at which its occlusion passes `threshold`; below 0: it is not. Steps of
// cone_step·d, d = diameter·t, at least a voxel; the first sphere lies at `start`. Empty space is crossed by coarser mips: where the eight texels around a
// point are empty, nothing lies within half a texel of it.
float find_hit_from(VoxelGrid grid, vec3 apex, vec3 direction, float diameter, float threshold, float start) {
    float t = start, end = reach * scene_diagonal;
    float open = 1.0;
    int coarsest = grid.skip_mips, skip = coarsest;
    for (int i = 0; i < max_steps && t < end; ++i) {
        vec3 centre = apex + t * direction;
        if (outside_grid(grid, centre)) return -1.0;
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

float find_hit(VoxelGrid grid, vec3 apex, vec3 direction, float diameter, float threshold) {
    return find_hit_from(grid, apex, direction, diameter, threshold, max(start_offset, 1.0e-3) * grid.voxel);
}

#endif
