#ifndef LIB_SHADOW_GLSL
#define LIB_SHADOW_GLSL
// Shadow maps: one 2D array, layer = light.shadow_base + face. Depth is larger when nearer. passes/surface/shadow_views.h
// mirrors the struct.
#include "lib/light.glsl"

struct ShadowView {
    mat4 view_projection;
    vec3 origin;
    float near_plane;
    vec3 direction;
    float range;      // metres; 0: perspective
    float texel_size; // perspective: metres at a distance of one metre; orthographic: metres
    float window;     // part of the map, 0 … window of its half width, that none of the light's other views shows
    float padding_x, padding_y;
};

// Distance along the view of a stored depth; far away where nothing was drawn.
float shadow_distance(ShadowView view, float depth) {
    if (depth <= 0.0) return 1.0e30;
    return view.range > 0.0 ? (1.0 - depth) * view.range : view.near_plane / depth;
}

// The view's right and up, as long as half its width (at one metre).
void view_axes(ShadowView view, out vec3 right, out vec3 up) {
    // The first two rows of the matrix are these, divided by their squared length.
    right = vec3(view.view_projection[0].x, view.view_projection[1].x, view.view_projection[2].x);
    up = vec3(view.view_projection[0].y, view.view_projection[1].y, view.view_projection[2].y);
    right /= dot(right, right);
    up /= dot(up, up);
}

// Which of a point light's six faces looks at `direction` (from the light).
int cube_face(vec3 direction) {
    vec3 a = abs(direction);
    if (a.x >= a.y && a.x >= a.z) return direction.x > 0.0 ? 0 : 1;
    if (a.y >= a.z) return direction.y > 0.0 ? 2 : 3;
    return direction.z > 0.0 ? 4 : 5;
}

int shadow_layer(Light light, vec3 position) {
    return light.shadow_base + (light.type == k_light_point ? cube_face(position - light.position) : 0);
}

// Distance along the view at which the ray through `ndc` meets the plane through `position`, kept within `max_offset` metres of
// `along`, the position's own distance: an edge-on plane is met anywhere.
float shadow_plane_distance(ShadowView view, vec2 ndc, vec3 position, vec3 normal, float along, float max_offset) {
    vec3 right, up;
    view_axes(view, right, up);
    vec3 across = ndc.x * right + ndc.y * up;
    vec3 from = position - view.origin;
    float met = view.range > 0.0 ? dot(normal, from - across) / dot(normal, view.direction)
                                 : dot(normal, from) / dot(normal, view.direction + across);
    return abs(met - along) < max_offset ? met : along + max_offset * sign(met - along);
}

// The share of the (2r+1)² texels around `position` from which the light is seen. `normal`: the geometric one, facing the
// light.
//
// With `receiver_plane`, a texel is compared with the depth of the surface's plane in the texel's own centre, where its
// depth was taken, or with the position's where that is nearer (beyond a crease, the plane may lie behind what is there):
// exact on planes without moving anything. Without it, the position's depth serves for all texels, and
// must be moved along the normal by `normal_offset` texels times the sine of the angle between the normal and the view's
// axis: on a plane, (r + ½)·√2 texels suffice (the depth of a tilted plane changes by tan θ a texel, and the move gains
// 1/cos θ). The axis and not the light's direction counts: away from the axis of a perspective view, even a plane that
// faces the light lies aslant to the texels. A move of d along the normal moves shadows by d·tan θ, always toward light.
float shadow_visibility(sampler2DArray shadow_map, ShadowView view, int layer, vec3 position, vec3 normal,
                        float normal_offset, float depth_bias, int radius, bool receiver_plane) {
    float cosine = clamp(abs(dot(normal, view.direction)), 0.0, 1.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float along = dot(position - view.origin, view.direction);
    float texel = view.range > 0.0 ? view.texel_size : view.texel_size * max(along, view.near_plane);
    float filtered = receiver_plane ? 0.0 : 1.4142 * float(radius);
    vec3 moved = position + normal * (texel * sine * (normal_offset + filtered));

    vec4 clip = view.view_projection * vec4(moved, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec2 uv = clip.xy / clip.w * 0.5 + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return 1.0; // outside the map
    along = dot(moved - view.origin, view.direction);
    float bias = depth_bias * texel;
    if (receiver_plane) {
        // Rasterizers snap vertices to 1/256 of a texel, which the slope of depth across the texels multiplies.
        vec3 ray = view.range > 0.0 ? view.direction : (moved - view.origin) / along;
        bias *= 1.0 + 0.1 * sine / max(abs(dot(normal, ray)), 1.0e-3);
    }
    const float k_steepest = 256.0;
    float max_offset = k_steepest * texel * float(radius + 1);

    ivec2 size = textureSize(shadow_map, 0).xy;
    ivec2 centre = ivec2(floor(uv * vec2(size)));
    float lit = 0.0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            ivec2 at = clamp(centre + ivec2(x, y), ivec2(0), size - 1);
            float here = along;
            if (receiver_plane) {
                vec2 ndc = (vec2(at) + 0.5) / vec2(size) * 2.0 - 1.0;
                here = min(along, shadow_plane_distance(view, ndc, moved, normal, along, max_offset));
            }
            lit += shadow_distance(view, texelFetch(shadow_map, ivec3(at, layer), 0).r) >= here - bias ? 1.0 : 0.0;
        }
    }
    return lit / float((2 * radius + 1) * (2 * radius + 1));
}

#endif
