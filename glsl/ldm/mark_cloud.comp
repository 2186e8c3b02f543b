// The fragments of a map as points in the picture: each pixel that one falls on is marked, 2 where it is in sight, 1 where it
// lies behind a surface.
#include "lib/frame.glsl"
#include "ldm/viewed_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_depth;
layout(FORMAT_debug_cloud_marks) uniform uimage2D debug_cloud_marks;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_viewed_now() || any(greaterThanEqual(texel, ivec2(ldm.resolution)))) return;
    LdmView view = views[viewed_map()];
    // The rows of the projection are at right angles: back by each of their inverses.
    vec3 right = view.to_x.xyz / dot(view.to_x.xyz, view.to_x.xyz), up = view.to_y.xyz / dot(view.to_y.xyz, view.to_y.xyz);
    vec3 along = view.to_z.xyz / dot(view.to_z.xyz, view.to_z.xyz);
    vec2 middle = vec2(texel) + 0.5 - vec2(view.to_x.w, view.to_y.w);
    for (LdmCursor node = ldm_first(ldm_head(viewed_slot(), texel)); !ldm_ended(node); node = ldm_next(node)) {
        vec3 x = middle.x * right + middle.y * up + (uintBitsToFloat(ldm_word(node, 0)) - view.to_z.w) * along;
        vec3 at = project_to_pixel(x);
        ivec2 pixel = ivec2(floor(at.xy));
        if (at.z < near_plane || any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, resolution))) continue;
        float depth = texelFetch(gbuffer_depth, pixel, 0).r;
        bool behind = depth > 0.0 && at.z > 1.01 * near_plane / depth;
        imageAtomicMax(debug_cloud_marks, pixel, behind ? 1u : 2u);
    }
}
