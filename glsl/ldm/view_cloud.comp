// The marked points (mark_cloud.comp) over the flat-shaded picture (LDM, Figure 3). White: in sight; red: behind a surface.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;
uniform usampler2D debug_cloud_marks;
layout(FORMAT_debug_cloud) writeonly uniform image2D debug_cloud;

uniform int points = 0; //! {in_sight, all} which are drawn: those that no surface hides, or all

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_cloud)))) return;
    vec3 colour = vec3(0.02, 0.022, 0.026);
    if (texelFetch(gbuffer_depth, pixel, 0).r > 0.0) {
        vec3 n = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        colour = vec3(0.04 + 0.2 * abs(dot(n, normalize(pixel_ray(vec2(pixel))))) + 0.06 * n.y);
    }
    uint mark = texelFetch(debug_cloud_marks, pixel, 0).r;
    if (mark == 2u) colour = vec3(1.0);
    if (mark == 1u && points == points_all) colour = mix(colour, vec3(0.7, 0.1, 0.05), 0.5);
    imageStore(debug_cloud, pixel, vec4(colour, 1.0));
}
