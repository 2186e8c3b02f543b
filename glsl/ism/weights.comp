// How likely each texel of the reflective shadow maps is to become a virtual point light: in proportion to its flux, as
// published, or in part to the area of surface that it shows. Integers, so that their prefix sum is exact: first the largest
// of each, then shares of it in up to 4096 steps, as many as the sum over all texels has room for.
#include "surface/map_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) buffer ism_largest { uint largest[]; }; // bits of floats ≥ 0: flux, area
layout(std430) writeonly buffer prefix_values { uint values[]; };

uniform int weight_stage;
uniform float by_area = 0.0; //! [0, 1] share of the virtual lights that is drawn by lit area instead of by flux

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = textureSize(rsm_depth, 0);
    if (any(greaterThanEqual(at, size))) return;
    MapTexel texel = map_texel(at);
    float flux = dot(texel.intensity, vec3(0.2126, 0.7152, 0.0722));
    float area = flux > 0.0 ? texel.area / max(texelFetch(rsm_radiance, at, 0).a, 0.05) : 0.0;
    if (weight_stage == 0) {
        atomicMax(largest[0], floatBitsToUint(flux));
        atomicMax(largest[1], floatBitsToUint(area));
        return;
    }
    float steps = clamp(1.0e9 / float(size.x * size.y * size.z), 1.0, 4096.0);
    float share = mix(flux / max(uintBitsToFloat(largest[0]), 1.0e-30), area / max(uintBitsToFloat(largest[1]), 1.0e-30), by_area);
    values[(at.z * size.y + at.y) * size.x + at.x] = flux > 0.0 ? uint(ceil(steps * share)) : 0u;
}
