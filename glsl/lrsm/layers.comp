// Builds the layers (LRSM, sections 4.3 and 5): one invocation a block of 2×2 texels of the reflective shadow map. Each
// texel goes to the layer of its depth and ⟨n·l⟩ (in a depth overlap, to both); texels of one block in one layer are
// merged. What is stored is weighted by opacity α, the share of the block's texels in the layer (Eq. 13), except that α
// of texels without a surface is 0: radiance·α and ⟨n·l⟩·α, n·α and α, then z·α, z²·α and α with z warped to the layer's
// range.
#include "surface/rsm_views.glsl"
#include "lrsm/partition.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray rsm_radiance;
uniform sampler2DArray rsm_normal;
uniform sampler2DArray rsm_depth;
layout(std430) readonly buffer lrsm_partitions { Partition partitions[]; };
layout(std430) readonly buffer lrsm_table { int table[]; };
layout(FORMAT_lrsm_radiance) writeonly uniform image2DArray lrsm_radiance;
layout(FORMAT_lrsm_normal) writeonly uniform image2DArray lrsm_normal;
layout(FORMAT_lrsm_depth) writeonly uniform image2DArray lrsm_depth;

uniform int depth_layers;
uniform int normal_layers;

void main() {
    ivec3 block = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(block.xy, imageSize(lrsm_radiance).xy)) || block.z >= partitions.length()) return;
    int view = block.z;
    Partition p = partitions[view];

    vec4 radiance[4], normal[4];
    float z[4];
    int n[4];
    for (int i = 0; i < 4; ++i) {
        ivec3 at = ivec3(2 * block.xy + ivec2(i & 1, i >> 1), view);
        float depth = texelFetch(rsm_depth, at, 0).r;
        radiance[i] = texelFetch(rsm_radiance, at, 0);
        normal[i] = texelFetch(rsm_normal, at, 0);
        z[i] = depth > 0.0 ? shadow_distance(views[view], depth) : -1.0;
        n[i] = normal_layer(p, normal_layers, radiance[i].a);
    }
    for (int d = 0; d < depth_layers; ++d) {
        vec2 range = layer_range(p, d);
        for (int k = 0; k < normal_layers; ++k) {
            int place = table[table_index(view, d, k)];
            if (place < 0) continue;
            vec4 radiance_sum = vec4(0.0), normal_sum = vec4(0.0), depth_sum = vec4(0.0);
            for (int i = 0; i < 4; ++i) {
                if (z[i] < 0.0 || n[i] != k || !in_depth_layer(p, d, z[i])) continue;
                float warped = warp_depth(range, z[i]);
                radiance_sum += 0.25 * radiance[i];
                normal_sum += 0.25 * vec4(normal[i].xyz, 1.0);
                depth_sum += 0.25 * vec4(warped, warped * warped, 1.0, 0.0);
            }
            imageStore(lrsm_radiance, ivec3(block.xy, place), radiance_sum);
            imageStore(lrsm_normal, ivec3(block.xy, place), normal_sum);
            imageStore(lrsm_depth, ivec3(block.xy, place), depth_sum);
        }
    }
}
