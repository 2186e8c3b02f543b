#ifndef LIB_ENVIRONMENT_GLSL
#define LIB_ENVIRONMENT_GLSL
// Radiance of the environment from a direction: u = atan2(d.z, d.x)/(2π) + ½, v = acos(d.y)/π (v = 0 is up).
#include "lib/frame.glsl"

uniform sampler2D scene_environment;

vec3 environment(vec3 d) {
    vec3 radiance = environment_radiance;
    if (environment_map != 0) {
        vec2 uv = vec2(atan(d.z, d.x) / 6.28318530718 + 0.5, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265359);
        radiance *= textureLod(scene_environment, uv, 0.0).rgb;
    }
    return radiance;
}
#endif
