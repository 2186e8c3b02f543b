// How many texels of the reflective shadow maps each layer holds, so that empty layers need no storage.
#include "surface/rsm_views.glsl"
#include "lrsm/partition.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2DArray rsm_radiance;
uniform sampler2DArray rsm_depth;
layout(std430) readonly buffer lrsm_partitions { Partition partitions[]; };
layout(std430) buffer lrsm_counts { uint counts[]; };

uniform int normal_layers;

shared uint tile[32]; // k_max_depth_layers · k_max_normal_layers

void main() {
    if (gl_LocalInvocationIndex < 32u) tile[gl_LocalInvocationIndex] = 0u;
    barrier();
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(at, textureSize(rsm_depth, 0)))) {
        float depth = texelFetch(rsm_depth, at, 0).r;
        if (depth > 0.0) {
            Partition p = partitions[at.z];
            float z = shadow_distance(views[at.z], depth);
            int n = normal_layer(p, normal_layers, texelFetch(rsm_radiance, at, 0).a);
            for (int d = 0; d < p.depth_layers; ++d)
                if (in_depth_layer(p, d, z)) atomicAdd(tile[table_index(0, d, n)], 1u);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex < 32u && tile[gl_LocalInvocationIndex] != 0u)
        atomicAdd(counts[table_index(at.z, 0, 0) + int(gl_LocalInvocationIndex)], tile[gl_LocalInvocationIndex]);
}
