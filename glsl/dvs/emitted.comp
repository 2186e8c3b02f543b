// Light of emissive surfaces, scattered once: E/π at each pixel from shadow rays toward points of them, drawn by power. What
// lies between blocks as voxels do, or as triangles.
#include "lib/frame.glsl"
uniform int visibility = 0; //! static {voxels, triangles} what hides an emitter
#if visibility == visibility_triangles
#include "traced/emitter_rays.glsl"
#else
#include "dvs/emitter_shadow.glsl"
// Nothing gathers occlusion along these rays.
VoxelGrid cone_grid() {
    return voxel_grid(textureSize(voxels_flags, 0).x, 1, 1, 0);
}
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return 0.0;
}
#endif
#include "traced/emitted_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_dvs_emitted) writeonly uniform image2D dvs_emitted;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    StartPoint start;
    vec3 light = start_at(pixel, start) ? emitted_light(pixel, start, 0.0) : vec3(0.0);
    imageStore(dvs_emitted, pixel, vec4(min(light, vec3(65504.0)), 1.0));
}
