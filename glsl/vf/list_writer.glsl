#ifndef VF_LIST_WRITER_GLSL
#define VF_LIST_WRITER_GLSL
// Writes one texel's visibility list.
#include "vf/lists.glsl"
#include "vf/march.glsl"

layout(std430) readonly buffer vf_light { ProxyLight lit[]; };
layout(std430) readonly buffer vf_cells { Cell cells[]; };
layout(std430) buffer vf_lists { uint lists[]; }; //! ordered: each invocation has its own list
layout(std430) buffer vf_counts { uint counts[]; };
layout(std430) readonly buffer vf_sizes { ivec2 march_size; int list_capacity, filtered_capacity; };

uniform float slack = 1.0;   //! [0, 16] (disc radii) ratio: discs that lie so little before a lit one do not hide it
uniform float skipped = 0.0; //! [0, 16] (disc radii) ratio: discs nearer to the ray's start than that are not met

int start_of_list, list_length = 0, wanted = 0;

// A list that holds `held` cells already.
void start_list(ivec2 texel, int held) {
    start_of_list = list_start(texel, march_size, list_capacity);
    list_length = wanted = held;
}

// Into the list, which stays in order.
void note_cell(uint cell, uint seen, uint crossed) {
    int entries = start_of_list + k_list_header, at = list_length;
    while (at > 0 && lists[entries + 2 * (at - 1)] > cell) --at;
    if (at > 0 && lists[entries + 2 * (at - 1)] == cell) {
        int place = entries + 2 * (at - 1) + 1;
        uvec2 had = unpacked_counts(lists[place]);
        lists[place] = packed_counts(had.x + seen, had.y + crossed);
        return;
    }
    ++wanted;
    if (list_length == list_capacity) return;
    for (int k = list_length; k > at; --k) {
        lists[entries + 2 * k] = lists[entries + 2 * k - 2];
        lists[entries + 2 * k + 1] = lists[entries + 2 * k - 1];
    }
    lists[entries + 2 * at] = cell;
    lists[entries + 2 * at + 1] = packed_counts(seen, crossed);
    ++list_length;
}

void finish_list() {
    lists[start_of_list] = uint(list_length);
    atomicMax(counts[0], uint(wanted));
    if (wanted > list_length) atomicAdd(counts[1], uint(wanted - list_length));
}

bool sends_light_to(uint i, vec3 direction) {
    vec3 light = dot(proxies[i].normal, direction) < 0.0 ? lit[i].front.rgb : lit[i].back.rgb;
    return max(light.r, max(light.g, light.b)) > 0.0;
}
#endif
