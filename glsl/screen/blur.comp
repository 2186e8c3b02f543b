// Cross-bilateral blur of occlusion: the mean over a box of `width` texels, times how well a texel's surface agrees in
// normal and in distance to the pixel's plane. As wide as the march's interleave, it sees every set of directions once.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;
uniform sampler2D screen_occlusion;
layout(FORMAT_screen_blurred) writeonly uniform image2D screen_blurred;  //! from out.ambient_occlusion, neutral 1

uniform int width = 4;                //! [1, 16] (texels) of the box; 1: no blur
uniform float normal_power = 16.0;    //! [0, 256] weights fall with ⟨n·n'⟩ to this power
uniform float plane_distance = 0.01;  //! [1e-4, 1] share of the distance to the viewer at which a texel off the plane counts 1/e

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float own = texelFetch(screen_occlusion, pixel, 0).r, depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth > 0.0 && width > 1) {
        vec3 position = world_position(pixel, depth), n = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        float tolerance = plane_distance * length(position - camera_position), sum = 0.0, total = 0.0;
        int side = width / 2;
        for (int y = -side; y <= side; ++y) {
            for (int x = -side; x <= side; ++x) {
                ivec2 at = pixel + ivec2(x, y);
                if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, resolution))) continue;
                float there = texelFetch(gbuffer_depth, at, 0).r;
                if (there <= 0.0) continue;
                // The box of an even width ends in the middle of its outer texels.
                float weight = width % 2 == 0 ? (abs(x) == side ? 0.5 : 1.0) * (abs(y) == side ? 0.5 : 1.0) : 1.0;
                float off_plane = dot(n, world_position(at, there) - position) / tolerance;
                weight *= pow(max(dot(n, normalize(texelFetch(gbuffer_geometric_normal, at, 0).xyz)), 0.0), normal_power) * exp(-off_plane * off_plane);
                sum += weight * texelFetch(screen_occlusion, at, 0).r;
                total += weight;
            }
        }
        own = total > 1.0e-4 ? sum / total : own;
    }
    imageStore(screen_blurred, pixel, vec4(own));
}
