#ifndef APP_TEXTURE_SOURCE_GLSL
#define APP_TEXTURE_SOURCE_GLSL
// One texel of any texture as floats, and the part of it that is shown.
#ifndef TEXTURE_SAMPLER
#define TEXTURE_SAMPLER sampler2D
#define TEXTURE_FLAT
#endif

uniform TEXTURE_SAMPLER viewed_texture;

uniform int mip;
uniform int layer;    // layer of an array, slice of a 3D texture
uniform int channel;  // 0 = RGB, 1 … 4 = one of R G B A, 5 = length of RGB
uniform int channels; // of the format
uniform int logarithmic;
uniform float value_scale; // of the first three channels: light is stored pre-exposed

vec4 fetch_texel(ivec2 at) {
#ifdef TEXTURE_FLAT
    vec4 value = vec4(texelFetch(viewed_texture, at, mip));
#else
    vec4 value = vec4(texelFetch(viewed_texture, ivec3(at, layer), mip));
#endif
    return value * vec4(vec3(value_scale), 1.0);
}

ivec2 viewed_size() {
    return textureSize(viewed_texture, mip).xy;
}

// A single channel is grey; what a format does not have is black.
vec3 shown_part(vec4 value) {
    if (channel == 5) return vec3(length(value.rgb));
    if (channel > 0) return vec3(value[channel - 1]);
    return channels == 1 ? value.rrr : channels == 2 ? vec3(value.rg, 0.0) : value.rgb;
}

// How many of the parts count: the third of two channels is no value.
int shown_count() {
    return channel > 0 || channels == 1 ? 1 : min(channels, 3);
}

// All of them as one number.
float shown_value(vec3 part) {
    if (shown_count() == 1) return part.x;
    return shown_count() == 2 ? 0.5 * (part.x + part.y) : dot(part, vec3(0.2126, 0.7152, 0.0722));
}

// 0 at low, 1 at high. A range without extent shows what lies on it as mid grey.
float position_in_range(float value, float low, float high) {
    if (low == high) return value < low ? 0.0 : value > high ? 1.0 : 128.0 / 255.0;
    if (logarithmic == 0) return clamp((value - low) / (high - low), 0.0, 1.0);
    // Nothing is at a finite distance from zero: six decades are enough for a picture.
    float least = max(low, high * 1.0e-6);
    if (value <= least || high <= least) return 0.0;
    return min(log(value / least) / log(high / least), 1.0);
}

// By their bits: compilers may take it that isnan() is never true.
bool is_nan(float x) {
    return (floatBitsToUint(x) & 0x7FFFFFFFu) > 0x7F800000u;
}
bool is_infinite(float x) {
    return (floatBitsToUint(x) & 0x7FFFFFFFu) == 0x7F800000u;
}

// Floats as unsigned integers of the same order, for atomics.
uint ordered_bits(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float from_ordered_bits(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7FFFFFFFu : ~bits);
}

#endif
