// Before and after the maps of a batch: empties the lists of all its texels; keeps account of the nodes.
#include "ldm/views.glsl"

layout(local_size_x = 256) in;

layout(std430) buffer ldm_lists { uint lists[]; };

void main() {
    for (uint i = gl_GlobalInvocationID.x; i < uint(ldm.heads); i += gl_NumWorkGroups.x * 256u)
        lists[i] = 0u;
}
