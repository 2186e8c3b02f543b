#ifndef LIB_LIGHT_GLSL
#define LIB_LIGHT_GLSL
// Punctual lights (KHR_lights_punctual, its units read as radiometric ones). passes/scene/light_falloff.h mirrors this file.

const uint k_light_point = 0u;
const uint k_light_spot = 1u;
const uint k_light_directional = 2u;

// 64 bytes in std430.
struct Light {
    vec3 position; // world, metres
    uint type;
    vec3 direction; // unit, the way light travels
    float inner_cone_cos;
    vec3 intensity; // point, spot: W/sr; directional: W/m² at normal incidence
    float outer_cone_cos;
    float radius;         // metres; 0 = hard
    float angular_radius; // radians; 0 = hard
    int shadow_base;      // first layer in the shadow map array; -1 = none
    int shadow_count;
};

// The extension's own angular attenuation; `to_point` is the unit direction from the light to the lit point.
// Its scale and offset are applied as one difference, which does not cancel at the rim.
float spot_falloff(Light light, vec3 to_point) {
    if (light.type != k_light_spot) return 1.0;
    float scale = 1.0 / max(0.001, light.inner_cone_cos - light.outer_cone_cos);
    float t = clamp((dot(light.direction, to_point) - light.outer_cone_cos) * scale, 0.0, 1.0);
    return t * t;
}

// The irradiance at normal incidence at x (W/m²) without occlusion, and the unit direction l from x to the light.
vec3 light_irradiance(Light light, vec3 x, out vec3 l) {
    if (light.type == k_light_directional) {
        l = -light.direction;
        return light.intensity;
    }
    vec3 to_light = light.position - x;
    float distance_squared = max(dot(to_light, to_light), 1.0e-20);
    l = to_light / sqrt(distance_squared);
    return light.intensity * (spot_falloff(light, -l) / distance_squared);
}

#endif
