// Stores the photons of a batch that arrived, each in the place that the prefix sum gives it, so that their order depends
// on nothing but their slots.
#include "ldm/photon_arrival.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer photons_emitters { Emitter emitters[]; };
layout(std430) readonly buffer photons_outcomes { uint outcomes[]; };
layout(std430) readonly buffer prefix_values { uint places[]; };
layout(std430) writeonly buffer photons_stored { Photon stored[]; };

uniform int batch;
uniform int emitter_count;

void main() {
    int emitter = int(gl_GlobalInvocationID.x), slot = int(gl_GlobalInvocationID.y), path = int(gl_GlobalInvocationID.z);
    if (emitter >= emitter_count || slot >= batch_maps(batch)) return;
    int at = (path * ldm.slots + slot) * emitter_count + emitter;
    uint place = places[at];
    if (outcomes[at] != k_outcome_arrived || place >= uint(stored.length())) return; // dropped: counted by finish_photons.comp
    Photon photon;
    photon_arrival(emitters[emitter], batch, slot, path, photon);
    stored[place] = photon;
}
