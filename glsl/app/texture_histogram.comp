// How the values of the shown part of a texture are spread over the range that it is shown with.
#include "app/texture_source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer viewed_range {
    uint low_bits, high_bits; // ordered
    uint non_finite;
};
// Steps from low to high, then what lies below and above.
layout(std430) buffer viewed_histogram {
    uint counts[66];
};

const uint k_steps = 64u;

shared uint group_counts[66];

void main() {
    for (uint i = gl_LocalInvocationIndex; i < k_steps + 2u; i += 64u) group_counts[i] = 0u;
    barrier();
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, viewed_size()))) {
        float value = shown_value(shown_part(fetch_texel(at)));
        float low = from_ordered_bits(low_bits), high = from_ordered_bits(high_bits);
        float share = position_in_range(value, low, high);
        uint place = min(uint(share * float(k_steps)), k_steps - 1u);
        if (value < min(low, high)) place = k_steps;
        if (value > max(low, high)) place = k_steps + 1u;
        if (!is_nan(value)) atomicAdd(group_counts[place], 1u);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < k_steps + 2u; i += 64u)
        if (group_counts[i] > 0u) atomicAdd(counts[i], group_counts[i]);
}
