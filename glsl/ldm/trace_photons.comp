// Traces the photons of all emitters along the axes of a batch, and notes what becomes of each in its own slot:
// outcome[(path · slots + slot) · emitters + emitter]. (The order by axis first keeps neighbouring photons together, which the
// splats profit from.) Those that arrive are counted for the prefix sum that gives them their places.
#include "ldm/photon_arrival.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer photons_emitters { Emitter emitters[]; };
layout(std430) writeonly buffer photons_outcomes { uint outcomes[]; };
layout(std430) writeonly buffer prefix_values { uint arrived[]; };

uniform int batch;
uniform int emitter_count;

void main() {
    int emitter = int(gl_GlobalInvocationID.x), slot = int(gl_GlobalInvocationID.y), path = int(gl_GlobalInvocationID.z);
    if (emitter >= emitter_count || slot >= ldm.slots) return;
    uint outcome = k_outcome_none;
    Photon photon;
    if (slot < batch_maps(batch)) outcome = photon_arrival(emitters[emitter], batch, slot, path, photon);
    int place = (path * ldm.slots + slot) * emitter_count + emitter;
    outcomes[place] = outcome;
    arrived[place] = outcome == k_outcome_arrived ? 1u : 0u;
}
