#ifndef SURFACE_START_GLSL
#define SURFACE_START_GLSL
// Where rays from the pixels of the G-buffer start.
#include "lib/frame.glsl"
#include "surface/gbuffer_surface.glsl"

struct StartPoint {
    vec3 position, face, normal;
    float distance; // from the camera, metres
    vec3 origin;    // off the surface
};

// The pixel that a texel of a smaller picture stands for.
ivec2 pixel_of(ivec2 texel, ivec2 size) {
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

// Rasterizers snap vertices to 1/256 of a pixel, by which the depth of a surface seen aslant is off; the rest is
// rounding.
bool start_at(ivec2 pixel, out StartPoint start) {
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return false;
    start.position = world_position(pixel, depth);
    start.face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    start.normal = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 to_viewer = camera_position - start.position;
    start.distance = length(to_viewer);
    float cosine = clamp(dot(start.face, to_viewer) / start.distance, 0.0, 1.0);
    float pixel_width = 2.0 * tan_half_vfov * start.distance / float(resolution.y);
    vec3 size = max(abs(start.position), vec3(start.distance));
    float off = pixel_width / 256.0 * sqrt(1.0 - cosine * cosine) + 4.0e-6 * max(size.x, max(size.y, size.z));
    start.origin = start.position + off * start.face;
    return true;
}

#endif
