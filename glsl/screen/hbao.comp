// Horizon-based ambient occlusion without attenuation, as far as the picture reaches (see screen/horizon.glsl): W = 1.
#include "screen/horizon.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_out_ambient_occlusion) writeonly uniform image2D out_ambient_occlusion;  //! neutral 1

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    imageStore(out_ambient_occlusion, pixel, vec4(horizon_visibility(pixel, 1.0e6 * scene_diagonal, false)));
}
