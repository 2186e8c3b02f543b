#ifndef VOXEL_CONE_GLSL
#define VOXEL_CONE_GLSL
// Occlusion α of a cone's spheres from occlusion voxels (LRSM, section 3.1), between mips and voxels linearly; it is
// gathered front to back (Eq. 1).
// With directional leaves the volume is six volumes one behind the other (voxel/occlusion_store.glsl): the three leaves
// that face the cone are summed with weights |direction_k|, and clamped to 1.
#include "voxel/cone_steps.glsl"

uniform sampler3D voxels_occlusion;

VoxelGrid occlusion_grid() {
    ivec3 size = textureSize(voxels_occlusion, 0);
    int leaves = size.z / size.x;
    // A single voxel of a leaf still shows in four mips of eight bits, one of a mean in two.
    return voxel_grid(size.x, leaves, textureQueryLevels(voxels_occlusion), leaves == 1 ? 2 : 4);
}

// α of a sphere, as seen along `direction`; 0 outside the grid.
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    vec3 at = (position - grid.origin) / grid.side;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 0.0;
    float alpha;
    if (grid.leaves == 1) {
        alpha = textureLod(voxels_occlusion, at, level).r;
    } else {
        // Inside its own volume: half a voxel of the coarser of the two mips away from the next one.
        float margin = 0.5 * exp2(ceil(level)) / float(grid.resolution);
        float z = clamp(at.z, margin, 1.0 - margin);
        alpha = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            int leaf = 2 * axis + (direction[axis] > 0.0 ? 1 : 0); // a surface that faces −axis blocks what goes along +axis
            alpha += abs(direction[axis]) * textureLod(voxels_occlusion, vec3(at.xy, (z + float(leaf)) / 6.0), level).r;
        }
        alpha = min(alpha, 1.0);
    }
    return corrected_opacity(alpha);
}

#endif
