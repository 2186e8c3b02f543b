// Virtual point lights: N texels at even distances in the running sum of their weights. Each stands for its texel's light
// over N times its probability.
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
    uint texels = uint(size.x * size.y * size.z), total = values[texels];
    Vpl vpl = Vpl(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    if (total > 0u) {
        // In the map's order: every k-th light is a fair part of all, as the interleaved gather takes them.
        float at = (float(i) + 0.5) / float(vpl_count);
        uint target = uint(min(at * float(total), float(total) - 1.0));
        uint low = 0u, high = texels;
        while (high - low > 1u) {
            uint middle = (low + high) / 2u;
            if (values[middle] <= target) low = middle;
            else high = middle;
        }
        MapTexel texel = map_texel(ivec3(low % uint(size.x), low / uint(size.x) % uint(size.y), low / uint(size.x * size.y)));
        float expected = float(vpl_count) * float(values[low + 1u] - values[low]) / float(total);
        vpl.position = texel.position;
        vpl.normal = texel.normal;
        vpl.intensity = texel.intensity / expected;
        vpl.area = texel.area / expected;
    }
    vpls[i] = vpl;
}
