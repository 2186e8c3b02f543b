#ifndef SURFACE_MAP_TEXEL_GLSL
#define SURFACE_MAP_TEXEL_GLSL
// A texel of a reflective shadow map as a small diffuse source (Dachsbacher & Stamminger 2005): where it lies, its normal, and
// its flux over π,
//   Φ_p/π = ρ·E·A⊥/π,   A⊥: the texel's section across the light's direction, m²; E: irradiance at normal incidence.
// The texel's surface has the area A⊥/⟨n·l⟩ and receives E·⟨n·l⟩, so the cosine drops out, and with it grazing texels.
#include "surface/rsm_views.glsl"

uniform sampler2DArray rsm_radiance; // ρ·E·⟨n·l⟩/π, ⟨n·l⟩
uniform sampler2DArray rsm_normal;
uniform sampler2DArray rsm_depth;

struct MapTexel {
    vec3 position;
    vec3 normal;    // toward the light
    vec3 intensity; // Φ_p/π, W/sr along the normal; 0: nothing is lit there
    float area;     // m², of the texel's section across the light's direction
};

MapTexel map_texel(ivec3 at) {
    MapTexel texel = MapTexel(vec3(0.0), vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
    float depth = texelFetch(rsm_depth, at, 0).r;
    vec4 radiance = texelFetch(rsm_radiance, at, 0);
    if (depth <= 0.0 || radiance.a <= 1.0e-3) return texel;
    ShadowView view = views[at.z];
    float along = shadow_distance(view, depth);
    vec3 right, up;
    view_axes(view, right, up);
    vec2 ndc = (vec2(at.xy) + 0.5) / vec2(textureSize(rsm_depth, 0).xy) * 2.0 - 1.0;
    vec3 across = ndc.x * right + ndc.y * up;
    // Where several views of one light overlap, each place counts in one of them.
    if (max(abs(ndc.x), abs(ndc.y)) > view.window) return texel;
    float side = view.texel_size;
    if (view.range > 0.0) {
        texel.position = view.origin + across + along * view.direction;
        texel.area = side * side;
    } else {
        vec3 ray = view.direction + across;
        texel.position = view.origin + along * ray;
        texel.area = side * side * along * along * inversesqrt(dot(ray, ray));
    }
    texel.normal = texelFetch(rsm_normal, at, 0).xyz;
    texel.intensity = radiance.rgb / radiance.a * texel.area;
    return texel;
}

// What it adds to E/π at x with normal n: (1/π)·(Φ_p/π)·⟨n_p·d⟩⟨n·−d⟩/(|x − x_p|² + r²), d the unit direction from the texel.
// `spread`: r² as a multiple of the texel's area over π, that of its disc; 0 as published, with VPLs' singularity.
vec3 texel_light(MapTexel texel, vec3 x, vec3 n, float spread) {
    vec3 to = x - texel.position;
    float squared = dot(to, to);
    float cosines = max(dot(texel.normal, to), 0.0) * max(-dot(n, to), 0.0);
    if (cosines <= 0.0) return vec3(0.0);
    const float k_inverse_pi = 0.318309886184;
    return texel.intensity * (cosines / squared / max(squared + spread * k_inverse_pi * texel.area, 1.0e-20) * k_inverse_pi);
}
#endif
