// A texture as a picture: values from low to high become 0 to 255, NaN magenta and infinities yellow.
#include "app/texture_source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer viewed_range {
    uint low_bits, high_bits; // ordered
    uint non_finite;
};
layout(rgba8) writeonly uniform image2D view_picture;

uniform int logarithmic;
uniform int encode_srgb;
uniform int mark_non_finite;

// 0 at low, 1 at high. A range without extent shows what lies on it as mid grey.
float position_in_range(float value, float low, float high) {
    if (low == high) return value < low ? 0.0 : value > high ? 1.0 : 128.0 / 255.0;
    if (logarithmic == 0) return clamp((value - low) / (high - low), 0.0, 1.0);
    // Nothing is at a finite distance from zero: six decades are enough for a picture.
    float least = max(low, high * 1.0e-6);
    if (value <= least || high <= least) return 0.0;
    return min(log(value / least) / log(high / least), 1.0);
}

float srgb_encode(float x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, viewed_size()))) return;
    vec3 part = shown_part(fetch_texel(at));

    bool nan = false, infinite = false;
    for (int i = 0; i < 3; ++i) {
        nan = nan || is_nan(part[i]);
        infinite = infinite || is_infinite(part[i]);
    }
    if (mark_non_finite == 1 && (nan || infinite)) {
        imageStore(view_picture, at, nan ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(1.0, 1.0, 0.0, 1.0));
        return;
    }

    bool empty = low_bits == 0xFFFFFFFFu; // nothing finite was found
    float low = empty ? 0.0 : from_ordered_bits(low_bits);
    float high = empty ? 1.0 : from_ordered_bits(high_bits);
    vec3 colour;
    for (int i = 0; i < 3; ++i) {
        bool there = i < shown_count() || shown_count() == 1;
        float x = !there || is_nan(part[i]) ? 0.0 : position_in_range(part[i], low, high);
        colour[i] = encode_srgb == 1 ? srgb_encode(x) : x;
    }
    imageStore(view_picture, at, vec4(colour, 1.0));
}
