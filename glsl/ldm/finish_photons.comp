// After a batch's photons are stored: the arguments of the draws and dispatches over them, and the frame's account.
layout(local_size_x = 1) in;

layout(std430) readonly buffer prefix_values { uint places[]; };
layout(std430) readonly buffer photons_stored { uint stored_words[]; };
// 0 … 3: glDrawArraysIndirect (4 vertices, instances, 0, 0) · 4 … 6: groups of 256 photons · 7: photons stored
layout(std430) writeonly buffer photons_commands { uint commands[]; };
// 0: photons of the largest batch · 1: dropped photons · 2: photons of the frame
layout(std430) buffer photons_counts { uint counted[]; }; //! ordered: one invocation

uniform int value_count;

void main() {
    uint arrived = places[value_count], capacity = uint(stored_words.length()) / 16u, kept = min(arrived, capacity);
    commands[0] = 4u;
    commands[1] = kept;
    commands[2] = commands[3] = 0u;
    commands[4] = (kept + 255u) / 256u;
    commands[5] = commands[6] = 1u;
    commands[7] = kept;
    counted[0] = max(counted[0], arrived);
    counted[1] += arrived - kept;
    counted[2] += arrived;
}
