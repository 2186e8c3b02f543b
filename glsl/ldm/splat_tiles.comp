// Splats by tiles: a group of 16 × 16 pixels goes through the chunks of 256 photons; of those whose box meets the tile it
// tests each photon's box, and every pixel adds up the ones that remain, in the order of the photons (so that two runs add
// alike).
#include "lib/frame.glsl"
#include "ldm/footprint.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std430) readonly buffer photons_stored { Photon stored[]; };
layout(std430) readonly buffer photons_commands { uint commands[]; };
layout(std430) readonly buffer photons_boxes { uvec2 boxes[]; };
layout(std430) readonly buffer photons_chunks { uvec2 chunks[]; };
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_photons_irradiance) uniform image2D photons_irradiance; // E/π so far

shared uint near_chunks[8], near_photons[8]; // a bit for each of 256

bool meets_tile(uvec2 box) {
    uvec2 low = uvec2(box.x & 0xffffu, box.x >> 16), high = uvec2(box.y & 0xffffu, box.y >> 16);
    uvec2 first = gl_WorkGroupID.xy * 16u, last = first + 15u;
    return all(lessThanEqual(low, last)) && all(greaterThanEqual(high, first));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), pixel = splat_pixel(texel);
    uint lane = gl_LocalInvocationIndex, count = commands[7], chunk_count = commands[4];
    bool inside = all(lessThan(texel, ivec2(splat_size)));
    float depth = inside ? texelFetch(gbuffer_depth, pixel, 0).r : 0.0;
    vec3 x = depth > 0.0 ? world_position(pixel, depth) : vec3(0.0);
    vec3 normal = depth > 0.0 ? texelFetch(gbuffer_normal, pixel, 0).xyz : vec3(0.0), sum = vec3(0.0);

    for (uint first = 0u; first < chunk_count; first += 256u) {
        if (lane < 8u) near_chunks[lane] = 0u;
        barrier();
        uint own = first + lane;
        if (own < chunk_count && meets_tile(chunks[own])) atomicOr(near_chunks[lane >> 5], 1u << (lane & 31u));
        barrier();
        for (uint word = 0u; word < 8u; ++word) {
            for (uint rest = near_chunks[word]; rest != 0u; rest &= rest - 1u) {
                uint chunk = first + word * 32u + uint(findLSB(rest));
                if (lane < 8u) near_photons[lane] = 0u;
                barrier();
                uint candidate = chunk * 256u + lane;
                if (candidate < count && meets_tile(boxes[candidate])) atomicOr(near_photons[lane >> 5], 1u << (lane & 31u));
                barrier();
                if (depth > 0.0) {
                    for (uint w = 0u; w < 8u; ++w) {
                        for (uint bits = near_photons[w]; bits != 0u; bits &= bits - 1u) {
                            Photon photon = stored[chunk * 256u + w * 32u + uint(findLSB(bits))];
                            vec3 n = footprint_normal(photon);
                            if (dot(n, normal) <= 0.0) continue; // it arrived on the other side
                            float l = footprint_distance(photon, n, x);
                            if (l < 1.0) sum += footprint_radiance(photon, l);
                        }
                    }
                }
                barrier();
            }
        }
        barrier();
    }
    if (inside) imageStore(photons_irradiance, texel, imageLoad(photons_irradiance, texel) + vec4(sum, 0.0));
}
