// 2/N times the sums of ambient_occlusion.comp, brought to the picture's size where they were taken at a lower one.
#include "lib/frame.glsl"
#include "ldm/views.glsl"
#include "surface/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D ldm_openness;
layout(FORMAT_out_ambient_occlusion) writeonly uniform image2D out_ambient_occlusion;  //! neutral 1
layout(FORMAT_out_ambient_occlusion_dmax) writeonly uniform image2D out_ambient_occlusion_dmax;  //! neutral 1

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    vec2 open = vec2(1.0); // the background
    if (texelFetch(gbuffer_depth, pixel, 0).r > 0.0)
        open = 2.0 / float(ldm.maps) * upsampled(ldm_openness, pixel, 1).rg;
    imageStore(out_ambient_occlusion, pixel, vec4(open.r));
    imageStore(out_ambient_occlusion_dmax, pixel, vec4(open.g));
}
