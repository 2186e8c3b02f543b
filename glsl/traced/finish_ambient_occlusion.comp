// Brings what ambient_occlusion.comp measured to the picture: a box as wide as the pattern's blocks, by planes and normals.
#include "lib/frame.glsl"
#include "surface/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D traced_openness;
layout(FORMAT_out_ambient_occlusion) writeonly uniform image2D out_ambient_occlusion;  //! neutral 1
layout(FORMAT_out_ambient_occlusion_dmax) writeonly uniform image2D out_ambient_occlusion_dmax;  //! neutral 1

uniform int box = 4; //! [1, 8] (texels) width of the box

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    vec2 open = vec2(1.0); // the background
    if (texelFetch(gbuffer_depth, pixel, 0).r > 0.0) open = upsampled(traced_openness, pixel, box).rg;
    imageStore(out_ambient_occlusion, pixel, vec4(open.r));
    imageStore(out_ambient_occlusion_dmax, pixel, vec4(open.g));
}
