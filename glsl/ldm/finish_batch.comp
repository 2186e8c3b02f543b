// After a batch: what it asked for joins the frame's account (see insert.glsl).
#include "ldm/views.glsl"

layout(local_size_x = 1) in;

layout(std430) buffer ldm_counts { uint ldm_counted[]; }; //! ordered: one invocation
layout(std430) writeonly buffer ldm_batches { uint fragments_of_batch[]; };

uniform int batch;

void main() {
    uint asked = ldm_counted[0];
    fragments_of_batch[batch] = asked;
    ldm_counted[1] = max(ldm_counted[1], asked);
    ldm_counted[2] += asked > uint(ldm.capacity) ? asked - uint(ldm.capacity) : 0u;
    ldm_counted[3] += asked;
    uint heads = uint(batch_maps(batch) * ldm.resolution * ldm.resolution);
    ldm_counted[4] += uint((float(heads) + float(asked) * float(ldm.node_words)) * (4.0 / 1024.0));
    ldm_counted[0] = 0u;
}
