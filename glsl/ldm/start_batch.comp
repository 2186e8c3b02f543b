// Before the maps of a batch: empties the lists of all its texels, and takes back the marks of build.comp.
#define WITHOUT_LDM_VIEWS
#include "ldm/views.glsl"

layout(local_size_x = 256) in;

layout(std430) writeonly buffer ldm_lists { uint lists[]; };
layout(std430) writeonly buffer ldm_counts { uint ldm_counted[]; };

uniform int marks_from; // in ldm_counts; they go on to its end

void main() {
    for (uint i = gl_GlobalInvocationID.x; i < uint(ldm.heads); i += gl_NumWorkGroups.x * 256u)
        lists[i] = 0u;
    for (uint i = uint(marks_from) + gl_GlobalInvocationID.x; i < uint(ldm_counted.length()); i += gl_NumWorkGroups.x * 256u)
        ldm_counted[i] = 0u;
}
