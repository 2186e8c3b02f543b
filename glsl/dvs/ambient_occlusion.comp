// Ambient occlusion at the pixel (1 = open) from the diffuse cones (DVS, section VIII.B), the nearest texel's.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D dvs_irradiance; // a = 1 − δ
layout(FORMAT_out_ambient_occlusion) writeonly uniform image2D out_ambient_occlusion;  //! neutral 1

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    ivec2 size = textureSize(dvs_irradiance, 0);
    imageStore(out_ambient_occlusion, pixel, vec4(texelFetch(dvs_irradiance, min(pixel * size / resolution, size - 1), 0).a));
}
