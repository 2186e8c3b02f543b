// How likely each texel of the reflective shadow maps is to become a virtual point light: in proportion to its flux, as
// published, or in part to the area of lit surface that it shows. All weights are shares of sums over the maps, so that neither
// the lights' strength nor the unit of length matters. They are integers, so that sums do not depend on an order: first the
// largest flux and area, then the sums of both in steps of these, then each texel's share of 10⁹.
#include "ism/texel_order.glsl"
#include "surface/map_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// of flux, of area; the largest as bits of floats ≥ 0
layout(std430) buffer ism_totals { uint largest[2], sums[2]; }; //! ordered: a stage either adds or reads
layout(std430) writeonly buffer prefix_values { uint values[]; };

uniform int weight_stage;
uniform float by_area = 0.0; //! [0, 1] share of the virtual lights that is drawn by lit area instead of by flux

// As a share of the largest of all texels.
float of_largest(float value, int k) {
    float most = uintBitsToFloat(largest[k]);
    return most > 0.0 ? value / most : 0.0;
}

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = textureSize(rsm_depth, 0);
    if (any(greaterThanEqual(at, size))) {
        // The order goes over a square of a power of two.
        if (weight_stage == 2) values[place_in_order(at, size)] = 0u;
        return;
    }
    MapTexel texel = map_texel(at);
    float flux = dot(texel.intensity, vec3(0.2126, 0.7152, 0.0722));
    float area = flux > 0.0 ? texel.area / max(texelFetch(rsm_radiance, at, 0).a, 0.05) : 0.0;
    if (weight_stage == 0) {
        atomicMax(largest[0], floatBitsToUint(flux));
        atomicMax(largest[1], floatBitsToUint(area));
        return;
    }
    // As many steps as the sum over all texels has room for.
    float steps = min(4.0e9 / (float(size.x) * float(size.y) * float(size.z)), 65536.0);
    vec2 share = steps * vec2(of_largest(flux, 0), of_largest(area, 1));
    if (weight_stage == 1) {
        atomicAdd(sums[0], uint(round(share.x)));
        atomicAdd(sums[1], uint(round(share.y)));
        return;
    }
    share /= max(vec2(sums[0], sums[1]), vec2(1.0));
    values[place_in_order(at, size)] = flux > 0.0 ? max(uint(round(1.0e9 * mix(share.x, share.y, by_area))), 1u) : 0u;
}
