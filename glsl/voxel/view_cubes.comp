// The occlusion voxels as cubes, from the camera: the first whose α passes `threshold`. Colour: α from blue over green to
// red, shaded by the face that the ray enters. a: distance to that face in metres, 0 where there is none.
#include "voxel/cube_march.glsl"
#include "voxel/leaf.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_voxels) writeonly uniform image2D debug_voxels;

uniform float threshold = 0.001;  //! [0, 1] least α of a voxel that is drawn

bool cube_is_drawn(ivec3 voxel) {
    return voxel_alpha(voxel) > threshold;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_voxels)))) return;
    CubeHit hit = march_cubes(pixel, view_resolution(), textureSize(voxels_occlusion, 0).x);
    vec3 colour = hit.distance > 0.0 ? hit.light * heat_colour(voxel_alpha(hit.voxel)) : k_cube_background;
    imageStore(debug_voxels, pixel, vec4(colour, hit.distance));
}
