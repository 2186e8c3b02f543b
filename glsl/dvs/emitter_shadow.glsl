#ifndef DVS_EMITTER_SHADOW_GLSL
#define DVS_EMITTER_SHADOW_GLSL
// Light of emissive triangles that voxels block. An emitter's own voxels do not hide it, nor what it hangs on.
#include "traced/emitter_light.glsl"
#include "dvs/voxel_blocks.glsl"

uniform float emitter_margin = 1.5; //! [0, 8] (voxels) what lies so near an emitter does not hide it

bool emitter_is_hidden(TracedSurface s, LightSample drawn, uint seed) {
    VoxelGrid grid = voxel_grid(textureSize(voxels_flags, 0).x, 1, 1, 0);
    vec3 apex = s.position + normal_offset * grid.voxel * s.face, way = start_off(s) + drawn.to_end - apex;
    float end = length(way) - emitter_margin * grid.voxel;
    if (end <= 0.0) return false;
    float t = find_blocking_voxel(grid, apex, normalize(way), start_offset * grid.voxel).t;
    return t >= 0.0 && t < end;
}

#endif
