#ifndef SURFACE_MAP_LIGHT_GLSL
#define SURFACE_MAP_LIGHT_GLSL
// What the lights make a point of a surface send back, read off the reflective shadow maps where it lies: of the four texels
// around it in a view those whose plane holds the point tell the light, those that are nearer to the light say that it is in
// shadow, and those that are farther away say nothing: there the light passes an edge.
#include "surface/rsm_maps.glsl"

uniform float map_thickness = 0.5; //! [0.05, 8] (texels) hit_lookup map, triangles: distance to a texel's plane within which it tells the light

// Of one view, layer `layer` of its maps. `direction`: of the ray that meets the point; the lit side of what it meets must
// face it. The point may lie `off` metres off the surface.
vec3 light_in_view(sampler2DArray radiance, sampler2DArray normal, sampler2DArray depths, ShadowView view, int layer, vec3 position, vec3 direction, float off) {
    vec4 clip = view.view_projection * vec4(position, 1.0);
    if (clip.w <= 0.0 || max(abs(clip.x), abs(clip.y)) > view.window * clip.w) return vec3(0.0);
    ivec2 size = textureSize(depths, 0).xy;
    float along = dot(position - view.origin, view.direction);
    vec3 right, up;
    view_axes(view, right, up);
    vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * vec2(size) - 0.5, corner = floor(at), share = at - corner;
    const float k_steepest = 16.0; // texels of depth a texel
    vec3 sum = vec3(0.0);
    float known = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1), texel = clamp(ivec2(corner) + step, ivec2(0), size - 1);
        float depth = texelFetch(depths, ivec3(texel, layer), 0).r;
        if (depth <= 0.0) continue;
        float z = shadow_distance(view, depth), scale = view.range > 0.0 ? 1.0 : z, width = view.texel_size * scale;
        float weight = (step.x == 1 ? share.x : 1.0 - share.x) * (step.y == 1 ? share.y : 1.0 - share.y);
        // Without a look at planes that are too steep to tell anything.
        if (abs(z - along) > k_steepest * width + off) {
            if (z < along) known += weight;
            continue;
        }
        vec2 ndc = (vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0;
        vec3 there = view.origin + z * view.direction + scale * (ndc.x * right + ndc.y * up);
        vec3 n = texelFetch(normal, ivec3(texel, layer), 0).xyz;
        if (abs(dot(there - position, n)) <= max(map_thickness * width, off)) {
            known += weight;
            if (dot(n, direction) < 0.0) sum += weight * texelFetch(radiance, ivec3(texel, layer), 0).rgb;
        } else if (z < along) {
            known += weight;
        }
    }
    return known > 0.0 ? sum / known : vec3(0.0);
}

// Of all lights.
vec3 map_light(vec3 position, vec3 direction) {
    vec3 light = vec3(0.0);
    for (int i = 0; i < views.length(); ++i)
        light += light_in_view(rsm_radiance, rsm_normal, rsm_depth, views[i], i, position, direction, 0.0);
    return light;
}

#endif
