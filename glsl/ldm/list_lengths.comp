// How many fragments each texel's list holds, for a prefix sum: where their arrays will begin.
#include "ldm/views.glsl"

layout(local_size_x = 256) in;

layout(std430) readonly buffer ldm_lists { uint lists[]; };
layout(std430) writeonly buffer prefix_values { uint lengths[]; };

void main() {
    for (uint head = gl_GlobalInvocationID.x; head < uint(ldm.heads); head += gl_NumWorkGroups.x * 256u) {
        uint length = 0u;
        for (uint node = lists[head]; node != 0u; node = lists[uint(ldm.heads) + (node - 1u) * uint(ldm.node_words) + 1u])
            ++length;
        lengths[head] = length;
    }
}
