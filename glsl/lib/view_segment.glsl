#ifndef LIB_VIEW_SEGMENT_GLSL
#define LIB_VIEW_SEGMENT_GLSL
// Straight segments of the scene drawn over a picture.
#include "lib/frame.glsl"

struct ViewSegment {
    vec4 ends;     // pixels: from, to
    vec2 nearness; // 1/distance along the view at both ends; below 0: not in view
};

// Cut off in front of the camera, by a share of its length: a float near 0 is not told from one at 0.
ViewSegment view_segment(vec3 start, vec3 stop) {
    ViewSegment segment = ViewSegment(vec4(0.0), vec2(-1.0));
    vec4 from = view_projection * vec4(start, 1.0), to = view_projection * vec4(stop, 1.0);
    float cut = max(near_plane, 1.0e-4 * max(abs(from.w), abs(to.w)));
    if (max(from.w, to.w) <= cut) return segment;
    if (from.w < cut) from = mix(to, from, (to.w - cut) / (to.w - from.w));
    if (to.w < cut) to = mix(from, to, (from.w - cut) / (from.w - to.w));
    segment.ends = (vec4(from.xy / from.w, to.xy / to.w) * 0.5 + 0.5) * vec4(resolution, resolution);
    segment.nearness = 1.0 / vec2(from.w, to.w);
    return segment;
}

// How much of a pixel a line of that width covers, and whether the segment is there behind a surface at `distance` along
// the view.
float segment_cover(ViewSegment segment, vec2 at, float width, float surface, out bool behind) {
    behind = false;
    if (segment.nearness.x < 0.0) return 0.0;
    vec2 along = segment.ends.zw - segment.ends.xy;
    float share = clamp(dot(at - segment.ends.xy, along) / max(dot(along, along), 1.0e-6), 0.0, 1.0);
    behind = 1.0 / mix(segment.nearness.x, segment.nearness.y, share) > 1.01 * surface;
    return clamp(width - distance(at, segment.ends.xy + share * along), 0.0, 1.0);
}

// A cross with a gap around a pixel.
bool on_pixel_cross(vec2 at, ivec2 pixel) {
    vec2 apart = abs(at - (vec2(pixel) + 0.5));
    float most = max(apart.x, apart.y);
    return min(apart.x, apart.y) < 0.6 && most > 3.0 && most < 10.0;
}

// Display values back to linear light.
vec3 decoded(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
#endif
