#ifndef LPV_LIGHT_GLSL
#define LPV_LIGHT_GLSL
// A cell's light: for red, green and blue the harmonics of l ≤ 1 of its radiant intensity, divided by the area of a cell's face
// (W/(sr·m²), so that the unit of length does not matter). A column a colour: (c_00, c_1x, c_1y, c_1z).
#include "lib/harmonics.glsl"

// Y(ω); Y(ω) * light is the intensity toward ω.
vec4 harmonics_of(vec3 direction) {
    return vec4(k_y0, k_y1 * direction);
}
// What sends I·⟨n·ω⟩⁺.
mat3x4 lobe_about(vec3 n, vec3 intensity) {
    return outerProduct(vec4(k_lobe0, k_lobe1 * n), intensity);
}

// A virtual point light: a texel of the reflective shadow maps. 32 bytes.
struct Vpl {
    vec3 normal;
    float share;    // ordinates: makes the sum over all directions what the lobe's integral is
    vec3 intensity; // W/sr along the normal
    float padding;
};
#endif
