// Which layer of the fixed pool holds which layer of which light: table[table_index] = place, or −1 for a layer
// that holds no texel (and for what the pool is too small for: counted in summary[1]). summary: layers stored, layers that
// found no place, then the depth layers of each light.
#include "lrsm/partition.glsl"

layout(local_size_x = 1) in;

layout(std430) readonly buffer lrsm_counts { uint counts[]; };  //! optional
layout(std430) readonly buffer lrsm_partitions { Partition partitions[]; };
layout(std430) writeonly buffer lrsm_table { int table[]; };
layout(std430) writeonly buffer lrsm_summary { int summary[]; };

uniform int depth_layers;
uniform int normal_layers;
uniform int pool_layers;
uniform bool skip_empty;

void main() {
    int stored = 0, overflow = 0;
    for (int i = 0; i < table.length(); ++i) {
        int place = -1;
        int d = i / k_max_normal_layers % k_max_depth_layers, n = i % k_max_normal_layers;
        if (d < depth_layers && n < normal_layers && (!skip_empty || counts[i] > 0u)) {
            if (stored < pool_layers) place = stored++;
            else ++overflow;
        }
        table[i] = place;
    }
    summary[0] = stored;
    summary[1] = overflow;
    for (int view = 0; view < partitions.length(); ++view)
        summary[2 + view] = partitions[view].depth_layers;
}
