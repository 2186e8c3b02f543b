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

// Distance along the view of a stored depth.
float shadow_distance(ShadowView view, float depth) {
    if (view.range > 0.0) return (1.0 - depth) * view.range;
    return depth > 0.0 ? view.near_plane / depth : 1.0e30;
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

// The share of the (2r+1)² texels around `position` from which the light is seen. `normal`: the geometric one, facing the
// light. The position is moved along the normal by `normal_offset` texels times the sine of the angle between the normal
// and the view's axis: on a plane, (r + ½)·√2 texels suffice (the depth of a tilted plane changes by tan θ a texel, and
// the move gains 1/cos θ). The axis and not the light's direction counts: away from the axis of a perspective view, even
// a plane that faces the light lies aslant to the texels.
float shadow_visibility(sampler2DArray shadow_map, ShadowView view, int layer, vec3 position, vec3 normal,
                        float normal_offset, float depth_bias, int radius) {
    float cosine = clamp(abs(dot(normal, view.direction)), 0.0, 1.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float along = dot(position - view.origin, view.direction);
    float texel = view.range > 0.0 ? view.texel_size : view.texel_size * max(along, view.near_plane);
    vec3 moved = position + normal * (texel * sine * (normal_offset + 1.4142 * float(radius)));

    vec4 clip = view.view_projection * vec4(moved, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec2 uv = clip.xy / clip.w * 0.5 + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return 1.0; // outside the map
    float distance_here = dot(moved - view.origin, view.direction) - depth_bias * texel;

    ivec2 size = textureSize(shadow_map, 0).xy;
    ivec2 centre = ivec2(floor(uv * vec2(size)));
    float lit = 0.0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            ivec2 at = clamp(centre + ivec2(x, y), ivec2(0), size - 1);
            lit += shadow_distance(view, texelFetch(shadow_map, ivec3(at, layer), 0).r) >= distance_here ? 1.0 : 0.0;
        }
    }
    return lit / float((2 * radius + 1) * (2 * radius + 1));
}

#endif
