#ifndef SURFACE_MAP_WALK_GLSL
#define SURFACE_MAP_WALK_GLSL
// Where a ray meets what the lights reach: it walks over the texels of a reflective shadow map, as a ray in screen space
// walks over the depth buffer. Each texel is a piece of plane: its centre's position and its normal. A ray that comes
// through that plane from its lit side meets it and sees its light; one that comes through from behind is blocked by it.
// So a thin sheet that is lit on its other side blocks. What no light reaches is in no map: voxels tell of it.
#include "surface/rsm_maps.glsl"

uniform float map_tolerance = 0.25; //! [0.05, 8] (texels) hit_lookup map: distance to a texel's plane that counts as a hit
uniform int map_steps = 64;        //! [4, 512] hit_lookup map: texels that a walk visits, at most

// The ray's texels between two distances. True where it meets something: `met` is its distance, `light` what it sends
// back along the ray. `in_light`: whether the light reaches all of the stretch; then nothing opaque crosses it.
bool walk_map(int view_index, vec3 surface, vec3 face, vec3 direction, float from, float to, out float met, out vec3 light, out bool in_light) {
    ShadowView view = views[view_index];
    met = to;
    light = vec3(0.0);
    in_light = true;
    vec2 size = vec2(textureSize(rsm_depth, 0).xy);
    vec4 first = view.view_projection * vec4(surface + from * direction, 1.0);
    vec4 last = view.view_projection * vec4(surface + to * direction, 1.0);
    if (first.w <= 0.0 || last.w <= 0.0) {
        in_light = false;
        return false;
    }
    vec2 across = abs(last.xy / last.w - first.xy / first.w) * 0.5 * size;
    int steps = clamp(int(ceil(1.25 * max(across.x, across.y))) + 1, 1, map_steps);
    vec3 right, up;
    view_axes(view, right, up);
    float stretch = (to - from) / float(steps);
    bool was_in_light = false, was_in_shadow = false; // of the texel before
    for (int i = 0; i < steps; ++i) {
        float t = from + float(i) * stretch;
        vec3 middle = surface + (t + 0.5 * stretch) * direction;
        vec4 clip = view.view_projection * vec4(middle, 1.0);
        vec2 plane = clip.xy / clip.w;
        if (max(abs(plane.x), abs(plane.y)) > view.window) {
            in_light = false; // for what this view can tell
            continue;
        }
        ivec2 texel = clamp(ivec2((plane * 0.5 + 0.5) * size), ivec2(0), ivec2(size) - 1);
        float depth = texelFetch(rsm_depth, ivec3(texel, view_index), 0).r;
        if (depth <= 0.0) {
            was_in_light = true;
            was_in_shadow = false;
            continue;
        }
        float z = shadow_distance(view, depth), along = dot(middle - view.origin, view.direction);
        float scale = view.range > 0.0 ? 1.0 : z, width = view.texel_size * scale;
        vec2 centre = (vec2(texel) + 0.5) / size * 2.0 - 1.0;
        vec3 there = view.origin + z * view.direction + scale * (centre.x * right + centre.y * up);
        vec3 n = texelFetch(rsm_normal, ivec3(texel, view_index), 0).xyz;
        float tolerance = map_tolerance * width;
        if (along > z + tolerance) in_light = false;
        bool enters_shadow = was_in_light && along > z, leaves_shadow = was_in_shadow && along <= z;
        was_in_light = along <= z;
        was_in_shadow = !was_in_light;
        if (dot(there - surface, face) <= tolerance) continue; // the receiver itself, or behind it
        float before = dot(surface + t * direction - there, n), after = before + stretch * dot(direction, n);
        // Steep surfaces: the planes of neighbouring texels leave gaps, between which depth itself changes sides.
        bool front = after < before && (enters_shadow || (before >= -tolerance && after <= tolerance));
        bool back = after > before && (leaves_shadow || (before < -tolerance && after >= -tolerance));
        if (!front && !back) continue;
        float crossed = t + stretch * clamp(before / (before - after), 0.0, 1.0);
        // Not the plane far above or below the texel: a steep one is as deep as its slope makes a texel.
        float cosine = max(abs(dot(n, view.direction)), 0.05), slope = sqrt(1.0 - cosine * cosine) / cosine;
        float off = dot(surface + crossed * direction - view.origin, view.direction) - z;
        if (abs(off) > width * (0.75 * slope + 1.0)) continue;
        met = crossed;
        if (front) light = texelFetch(rsm_radiance, ivec3(texel, view_index), 0).rgb;
        return true;
    }
    return false;
}

// The same over the maps of all lights: the nearest of what they show blocks the rest; what two lights show in one place
// is lit by both.
bool walk_maps(vec3 surface, vec3 face, vec3 direction, float from, float to, float same_place, out float met, out vec3 light, out bool in_light) {
    met = 3.0e38;
    light = vec3(0.0);
    in_light = false;
    vec3 others = vec3(0.0); // of `light`, what is not from the light of view `last`
    int last = -1;
    for (int view = 0; view < views.length(); ++view) {
        float at;
        vec3 sent;
        bool lit_all;
        bool any_met = walk_map(view, surface, face, direction, from, to, at, sent, lit_all);
        in_light = in_light || (lit_all && !any_met);
        if (!any_met || at > met + same_place) continue;
        // At their common edge two views of a point light show the same place: it is lit once.
        bool same_light = last >= 0 && views[view].window < 1.0 && views[view].origin == views[last].origin;
        if (same_light && at >= met) continue;
        if (at < met - same_place) others = vec3(0.0);
        else if (!same_light) others = light;
        light = others + sent;
        met = min(met, at);
        last = view;
    }
    return met < 3.0e38;
}

#endif
