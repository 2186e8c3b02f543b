#ifndef VF_EMITTERS_GLSL
#define VF_EMITTERS_GLSL
// What one proxy, or one cell as a whole, sends to a point (VF, Eq. 6).
#include "lib/harmonics.glsl"
#include "vf/grid.glsl"

uniform float spread = 1.0; //! [0, 16] a proxy is softened like a disc of so many times its area; 0: VPLs' singularity
uniform int lobe = 0;       //! {linear, clamped} a cell's light by direction: ¼ + ½cosθ of l ≤ 1, or a clamped cosine along its l = 1

const float k_inverse_pi = 0.318309886184;

// The intensity that a proxy sends toward x over the squared distance (W/(sr·m²)); `away`: unit, from x to the proxy.
vec3 proxy_light(Proxy proxy, ProxyLight light, vec3 x, out vec3 away, out float solid_angle) {
    vec3 to = proxy.position - x;
    float squared = max(dot(to, to), 1.0e-20);
    away = to * inversesqrt(squared);
    float cosine = -dot(proxy.normal, away);
    float reached = 1.0 / max(squared + spread * k_inverse_pi * proxy.area, 1.0e-20);
    solid_angle = abs(cosine) * proxy.area * reached;
    return (cosine > 0.0 ? light.front.rgb : light.back.rgb) * (abs(cosine) * reached);
}

// The intensity that a cell sends along `out_of` (unit), W/sr.
vec3 cell_intensity(Cell cell, vec3 out_of) {
    if (lobe == lobe_linear) {
        vec3 along = cell.c1[0].rgb * out_of.x + cell.c1[1].rgb * out_of.y + cell.c1[2].rgb * out_of.z;
        return max(k_y0 * cell.c00.rgb + k_y1 * along, vec3(0.0));
    }
    // Σ I and Σ I·n again; their ratio says how much of the light leaves one way.
    vec3 sum = cell.c00.rgb / k_lobe0;
    const vec3 k_bright = vec3(0.2126, 0.7152, 0.0722);
    vec3 axis = vec3(dot(cell.c1[0].rgb, k_bright), dot(cell.c1[1].rgb, k_bright), dot(cell.c1[2].rgb, k_bright)) / k_lobe1;
    float size = length(axis), directed = clamp(size / max(dot(sum, k_bright), 1.0e-30), 0.0, 1.0);
    float cosine = size > 0.0 ? max(dot(axis, out_of) / size, 0.0) : 0.0;
    return sum * mix(0.25, cosine, directed);
}
#endif
