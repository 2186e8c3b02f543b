#ifndef TRACED_LIGHT_GLSL
#define TRACED_LIGHT_GLSL
// What the punctual lights send to a traced surface: by shadow rays, or by the shadow maps.
#include "lib/shadow.glsl"
#include "traced/surface.glsl"
#include "traced/trace.glsl"

uniform bool shadow_rays = false; //! static light at hits: a ray toward each light; off: the shadow maps
#if !shadow_rays
uniform sampler2DArray shadow_depth;                                 //! optional
layout(std430) readonly buffer shadow_views { ShadowView views[]; }; //! optional
#endif

float light_seen(Light light, TracedSurface s, vec3 l, uint seed) {
#if shadow_rays
    if (light.type == k_light_directional) return trace_any(start_off(s), l, 3.0e38, seed) ? 0.0 : 1.0;
    // To where the surface itself looks at, and a little short of it, in case the light touches a surface.
    vec3 to_light = light.position - s.position;
    return trace_any(start_off(s), to_light - s.offset * s.face, 1.0 - 1.0e-6, seed) ? 0.0 : 1.0;
#else
    if (light.shadow_base < 0) return 1.0;
    int layer = shadow_layer(light, s.position);
    return shadow_visibility(shadow_depth, views[layer], layer, s.position, s.face, 0.125, 0.3, 0, true);
#endif
}

// Radiance that the surface scatters once toward v, from all lights; with both lobes or the diffuse one alone.
vec3 scattered_light(TracedSurface s, vec3 v, bool diffuse_lobe_only, uint seed) {
    vec3 radiance = vec3(0.0);
    for (int i = 0; i < light_count; ++i) {
        vec3 l;
        vec3 irradiance = light_irradiance(lights[i], s.position, l);
        float cosine = dot(s.shading, l);
        bool reaches = cosine > 0.0 && dot(s.face, l) > 0.0 && max(irradiance.r, max(irradiance.g, irradiance.b)) > 0.0;
        if (!reaches) continue;
        vec3 f = diffuse_lobe_only ? diffuse_lobe(s.shading, v, l, s.base_colour, s.metallic, s.roughness)
                                   : surface_lobes(s.shading, v, l, s.base_colour, s.metallic, s.roughness);
        radiance += f * irradiance * (cosine * light_seen(lights[i], s, l, seed));
    }
    return radiance;
}

#endif
