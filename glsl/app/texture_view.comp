// A texture as a picture: values from low to high become 0 to 255, NaN magenta and infinities yellow.
#include "app/texture_source.glsl"
#include "lib/heat_colour.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer viewed_range {
    uint low_bits, high_bits; // ordered
    uint non_finite;
};
layout(rgba8) writeonly uniform image2D view_picture;

uniform int encode_srgb;
uniform int false_colour; // one number as a colour: of several channels, their luminance
uniform int mark_non_finite;

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
    if (false_colour == 1) {
        float value = shown_value(part);
        imageStore(view_picture, at, vec4(is_nan(value) ? vec3(0.0) : heat_colour(position_in_range(value, low, high)), 1.0));
        return;
    }
    vec3 colour;
    for (int i = 0; i < 3; ++i) {
        bool there = i < shown_count() || shown_count() == 1;
        float x = !there || is_nan(part[i]) ? 0.0 : position_in_range(part[i], low, high);
        colour[i] = encode_srgb == 1 ? srgb_encode(x) : x;
    }
    imageStore(view_picture, at, vec4(colour, 1.0));
}
