// The recorded rays of one pixel (inspect_rays.comp), drawn over the picture: from the surface to what they meet (orange, a
// dot at the hit), or out of the scene (blue). Steep ones are brighter, as they count for more. What lies behind the
// picture's surfaces is fainter.
#include "lib/view_segment.glsl"
#include "ldm/trace_record.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D out_display;
uniform sampler2D gbuffer_depth;
layout(std430) readonly buffer debug_rays {
    TracedPixel traced;
    RecordedRay rays[];
};
layout(FORMAT_debug_rays_view) writeonly uniform image2D debug_rays_view;

uniform int show = 0;            //! {all, hits, open} which rays are drawn
uniform float line_width = 1.0;  //! [0.5, 8] (pixels) of rays
uniform float picture = 0.5;     //! [0, 1] brightness of the picture behind

shared ViewSegment segments[256];
shared vec2 kinds[256]; // brightness, 1: hits something

void main() {
    int lane = int(gl_LocalInvocationIndex), count = traced.rays;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = all(lessThan(pixel, imageSize(debug_rays_view)));
    vec2 at = vec2(pixel) + 0.5;
    vec3 colour = vec3(0.0);
    float surface = 1.0e30;
    if (inside) {
        colour = picture * decoded(texelFetch(out_display, pixel, 0).rgb);
        float depth = texelFetch(gbuffer_depth, pixel, 0).r;
        if (depth > 0.0) surface = near_plane / depth;
    }
    for (int first = 0; first < count; first += 256) {
        barrier();
        if (first + lane < count) {
            RecordedRay ray = rays[first + lane];
            bool hits = ray.distance < 1.0e30;
            segments[lane] = view_segment(traced.x, traced.x + min(ray.distance, scene_diagonal) * ray.direction);
            if (ray.cosine <= 0.0 || (show == show_hits && !hits) || (show == show_open && hits)) segments[lane].nearness = vec2(-1.0);
            kinds[lane] = vec2(sqrt(ray.cosine), hits ? 1.0 : 0.0);
        }
        barrier();
        for (int i = 0; i < min(256, count - first); ++i) {
            bool behind;
            float cover = segment_cover(segments[i], at, line_width, surface, behind);
            bool hits = kinds[i].y > 0.5;
            float dot_cover = hits && segments[i].nearness.x >= 0.0 ? clamp(line_width + 1.5 - distance(at, segments[i].ends.zw), 0.0, 1.0) : 0.0;
            cover = max(0.55 * cover * kinds[i].x * (behind ? 0.2 : 1.0), dot_cover);
            colour = mix(colour, hits ? vec3(1.0, 0.45, 0.05) : vec3(0.15, 0.5, 1.0), cover);
        }
    }
    if (!inside) return;
    if (on_pixel_cross(at, traced.pixel)) colour = vec3(1.0, 1.0, 0.2);
    imageStore(debug_rays_view, pixel, vec4(colour, 1.0));
}
