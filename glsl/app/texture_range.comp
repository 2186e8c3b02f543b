// The least and the greatest finite value of the shown part of a texture, and how many of its texels are not finite.
#include "app/texture_source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Before: low = ~0, high = 0, non_finite = 0.
layout(std430) buffer viewed_range {
    uint low_bits, high_bits; // ordered
    uint non_finite;
};

shared uint group_low, group_high, group_non_finite;

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        group_low = 0xFFFFFFFFu;
        group_high = 0u;
        group_non_finite = 0u;
    }
    barrier();
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, viewed_size()))) {
        vec3 part = shown_part(fetch_texel(at));
        bool bad = false;
        for (int i = 0; i < shown_count(); ++i) {
            if (is_nan(part[i]) || is_infinite(part[i])) {
                bad = true;
                continue;
            }
            atomicMin(group_low, ordered_bits(part[i]));
            atomicMax(group_high, ordered_bits(part[i]));
        }
        if (bad) atomicAdd(group_non_finite, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicMin(low_bits, group_low);
        atomicMax(high_bits, group_high);
        if (group_non_finite > 0u) atomicAdd(non_finite, group_non_finite);
    }
}
