// Splats by tiles: every texel goes through its tile's list and adds up the photons whose footprint covers it, in their
// order (so that two runs add alike), and writes once. (A list of more than 65,535 photons would be cut off by drivers that
// bound loops; a batch's are far shorter.)
#include "lib/frame.glsl"
#include "ldm/footprint.glsl"
#include "ldm/tiles.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer photons_stored { Photon stored[]; };
layout(std430) readonly buffer photons_boxes { uvec2 boxes[]; };
layout(std430) readonly buffer prefix_values { uint starts[]; };
layout(std430) readonly buffer splat_lists { uint splat_list[]; };
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_photons_irradiance) uniform image2D photons_irradiance; //! ordered: each invocation has its own texel // E/π so far

uniform int chunk_count;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(splat_size)))) return;
    ivec2 pixel = splat_pixel(texel);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return;
    vec3 x = world_position(pixel, depth), normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, sum = vec3(0.0);
    int tile = (texel.y / k_tile) * tiles_across() + texel.x / k_tile;
    uint first = starts[tile * chunk_count], last = min(starts[(tile + 1) * chunk_count], uint(splat_list.length()));
    for (uint i = first; i < last; ++i) {
        uint index = splat_list[i];
        if (!box_meets(boxes[index], uvec2(texel), uvec2(texel))) continue;
        Photon photon = stored[index];
        vec3 n = footprint_normal(photon);
        if (dot(n, normal) <= normal_agreement) continue; // it arrived on another side
        float l = footprint_distance(photon, n, x);
        if (l < 1.0) sum += footprint_radiance(photon, l);
    }
    imageStore(photons_irradiance, texel, imageLoad(photons_irradiance, texel) + vec4(sum, 0.0));
}
