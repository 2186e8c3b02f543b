// Virtual point lights: N texels at even distances in the running sum of their weights along a curve that keeps neighbours
// together, so that they lie evenly in the maps. Each stands for its texel's light over N times its probability.
#include "ism/texel_order.glsl"
#include "ism/vpl.glsl"
#include "surface/map_texel.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer prefix_values { uint values[]; };
layout(std430) writeonly buffer ism_vpls { Vpl vpls[]; };

uniform int vpl_count;

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= vpl_count) return;
    ivec3 size = textureSize(rsm_depth, 0);
    uint texels = places_in_order(size), total = values[texels];
    Vpl vpl = Vpl(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    if (total > 0u) {
        // Every k-th light is a fair part of all, as the interleaved gather takes them.
        float at = (float(i) + 0.5) / float(vpl_count);
        uint target = uint(min(at * float(total), float(total) - 1.0));
        uint low = 0u, high = texels;
        while (high - low > 1u) {
            uint middle = (low + high) / 2u;
            if (values[middle] <= target) low = middle;
            else high = middle;
        }
        ivec3 at_texel = texel_at_place(low, size);
        MapTexel texel = map_texel(at_texel);
        float expected = float(vpl_count) * float(values[low + 1u] - values[low]) / float(total);
        vpl.position = texel.position;
        vpl.normal = texel.normal;
        vpl.intensity = texel.intensity / expected;
        vpl.area = texel.area / max(texelFetch(rsm_radiance, at_texel, 0).a, 0.05) / expected;
    }
    vpls[i] = vpl;
}
