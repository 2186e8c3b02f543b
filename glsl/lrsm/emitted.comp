// Light of emissive surfaces, scattered once: E/π at each pixel from shadow rays toward points of them, drawn by power. What
// lies between blocks as occlusion voxels do, or as triangles.
#include "lib/frame.glsl"
uniform int visibility = 0; //! static {voxels, triangles} what hides an emitter
#if visibility == visibility_triangles
#include "traced/emitter_rays.glsl"
#else
#include "traced/emitter_light.glsl"
#include "voxel/exact_hit.glsl"

uniform float emitter_margin = 1.5; //! [0, 8] (voxels) what lies so near an emitter does not hide it: its own voxels, what it hangs on

bool emitter_is_hidden(TracedSurface s, LightSample drawn, uint seed) {
    VoxelGrid grid = cone_grid();
    vec3 apex = cone_start(grid, s.position, s.face).apex, way = start_off(s) + drawn.to_end - apex;
    float end = length(way) - emitter_margin * grid.voxel;
    if (end <= 0.0) return false;
    float t = find_exact_hit(grid, apex, normalize(way), max(start_offset, 1.0e-3) * grid.voxel).t;
    return t >= 0.0 && t < end;
}
#endif
#include "traced/emitted_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_lrsm_emitted) writeonly uniform image2D lrsm_emitted;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    StartPoint start;
    vec3 light = start_at(pixel, start) ? emitted_light(pixel, start, 0.0) : vec3(0.0);
    imageStore(lrsm_emitted, pixel, vec4(min(light, vec3(65504.0)), 1.0));
}
