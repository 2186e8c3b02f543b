// Each cell's light in spherical harmonics (VF, Eq. 2–3) of l = 0 and 1, and the centroid of its virtual point lights. A
// light's lobe I·⟨n·ω⟩⁺ has the coefficients c_00 = √π/2·I and c_1m = √(π/3)·I·n_m. One invocation a cell, in order: sums
// of floats by atomics would differ from run to run.
#include "lib/harmonics.glsl"
#include "vf/grid.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) readonly buffer vf_ranges { uvec2 ranges[]; };
layout(std430) readonly buffer vf_proxies { Proxy proxies[]; };
layout(std430) readonly buffer vf_light { ProxyLight lit[]; };
layout(std430) writeonly buffer vf_cells { Cell cells[]; };

void main() {
    uint c = gl_GlobalInvocationID.x;
    if (c >= uint(grid.count)) return;
    vec3 sum = vec3(0.0), along[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0)), centre = vec3(0.0);
    float weight = 0.0, area = 0.0;
    uvec2 range = ranges[2u * c];
    for (uint i = range.x; i < range.y; ++i) {
        vec3 n = proxies[i].normal, front = lit[i].front.rgb, back = lit[i].back.rgb;
        sum += front + back;
        for (int k = 0; k < 3; ++k)
            along[k] += n[k] * (front - back);
        float brightness = dot(front + back, vec3(0.2126, 0.7152, 0.0722));
        centre += brightness * proxies[i].position;
        weight += brightness;
        area += proxies[i].area;
    }
    Cell cell;
    cell.c00 = vec4(k_lobe0 * sum, weight > 0.0 ? 1.0 : 0.0);
    for (int k = 0; k < 3; ++k)
        cell.c1[k] = vec4(k_lobe1 * along[k], 0.0);
    vec3 middle = grid.origin + (vec3(cell_of_index(c, grid.size)) + 0.5) * grid.cell;
    cell.middle = vec4(weight > 0.0 ? centre / weight : middle, area);
    cells[c] = cell;
}
