#ifndef LPV_GATHER_GLSL
#define LPV_GATHER_GLSL
// Each texel's light from the cells around its point, of the cascades that it lies in: the finest first, which fade into the next.
#include "lib/frame.glsl"
#include "surface/start.glsl"
#include "lpv/corners.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_lpv_irradiance) writeonly uniform image2D lpv_irradiance;

const float k_inverse_pi = 0.318309886184;

// E/π of one cascade at x; `face`: the triangle's normal, n: the shading normal.
vec3 irradiance_at(int cascade, vec3 x, vec3 face, vec3 n);

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(lpv_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint own;
    vec3 sum = vec3(0.0);
    if (start_at(pixel_of(texel, size), own)) {
        float left = 1.0;
        for (int cascade = 0; cascade < grid_cascades && left > 0.0; ++cascade) {
            float share = left * share_of_cascade(cascade, own.position);
            if (share <= 0.0) continue;
            sum += share * irradiance_at(cascade, own.position, own.face, own.normal);
            left -= share;
        }
    }
    imageStore(lpv_irradiance, texel, vec4(min(sum, vec3(65504.0)), 1.0));
}
#endif
