// Linear radiance → display: exposure, a tone curve, the sRGB encoding.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D out_radiance;
layout(FORMAT_out_display) writeonly uniform image2D out_display;

uniform float exposure = 0.0;  //! [-16, 16] (stops) radiance is multiplied by 2^exposure
uniform int curve = 0;         //! {none, aces_like} tone curve: none clips at 1

// The rational fit of the ACES film curve by Narkowicz (2015).
vec3 aces_like(vec3 x) {
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

vec3 srgb_encode(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_display)))) return;
    vec3 x = texelFetch(out_radiance, pixel, 0).rgb * (exp2(exposure) / pre_exposure);
    if (curve == curve_aces_like) x = aces_like(x);
    imageStore(out_display, pixel, vec4(srgb_encode(clamp(x, 0.0, 1.0)), 1.0));
}
