#ifndef TRACED_SOFT_LIGHTS_GLSL
#define TRACED_SOFT_LIGHTS_GLSL
// Punctual lights with a radius, as spheres or cones of directions of even radiance whose irradiance at normal incidence is
// that of the hard light; they are not seen and block nothing (passes/reference/punctual_lights.cpp). Include
// traced/light_tables.glsl and lib/sampling.glsl before this file.

bool light_is_soft(Light light) {
    return light.type == k_light_directional ? light.angular_radius > 0.0 : light.radius > 0.0;
}

// Squared sine of the half-angle that the light fills. From (nearly) inside of a sphere, it just does not reach the point.
float light_sine2(Light light, float distance2) {
    float sine = sin(light.angular_radius);
    return light.type == k_light_directional ? sine * sine : min(light.radius * light.radius / distance2, 0.99);
}

// A direction toward the light; for a hard one the only one, with density −1.
LightSample draw_light(Light light, TracedSurface from, vec2 u) {
    vec3 l, irradiance = light_irradiance(light, from.position, l), to_light = light.position - from.position;
    bool directional = light.type == k_light_directional;
    float distance2 = dot(to_light, to_light), away = sqrt(distance2);
    LightSample drawn = LightSample(l, l, 3.0e38, irradiance, -1.0);
    if (light_is_soft(light)) {
        float sine2 = light_sine2(light, distance2);
        vec3 local = cone_direction(sine2, u);
        away *= local.z - sqrt(max(0.0, sine2 - max(0.0, 1.0 - local.z * local.z))); // the near side of the sphere
        drawn.direction = frame_around(l) * local;
        drawn.density = cone_density(sine2);
        drawn.radiance = irradiance / (k_pi * sine2);
    }
    drawn.to_end = drawn.direction;
    if (!directional) {
        // To where the surface itself looks at, and a little short of it, in case the light touches a surface.
        drawn.to_end = drawn.direction * away - from.offset * from.face;
        drawn.reach = 1.0 - 1.0e-6;
    }
    return drawn;
}

// Of a ray that goes `far` from a surface: the light's radiance, and in a the density with which draw_light draws it; 0
// where it does not meet it.
vec4 meet_light(Light light, vec3 from, vec3 direction, float far) {
    if (!light_is_soft(light)) return vec4(0.0);
    vec3 l, irradiance = light_irradiance(light, from, l), to_light = light.position - from, across = cross(l, direction);
    float distance2 = dot(to_light, to_light), sine2 = light_sine2(light, distance2), here2 = dot(across, across), cosine = dot(l, direction);
    if (cosine <= 0.0 || here2 >= sine2) return vec4(0.0);
    bool directional = light.type == k_light_directional;
    float reach = directional ? 3.0e38 : sqrt(distance2) * (cosine - sqrt(sine2 - here2));
    if (directional ? far < reach : far <= reach) return vec4(0.0);
    return vec4(irradiance / (k_pi * sine2), cone_density(sine2));
}

float light_importance(Light light, vec3 from) {
    vec3 l;
    return luminance(light_irradiance(light, from, l));
}

#endif
