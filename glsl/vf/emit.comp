// The point proxies (VF, section 3.1): each on its triangle at barycentrics from a Halton sequence, folded into the triangle.
// A triangle worth one proxy or more shares its own area among those that it gets; smaller ones get one by chance, which then
// stands for 1/density. Proxies where alpha cuts the surface away, and outside of the grid, get no cell.
#define SCENE_MATERIALS
#include "vf/grid.glsl"
#include "vf/triangles.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer vf_grid { Grid grid; }; //! ordered: what is read was written by earlier passes
layout(std430) readonly buffer prefix_values { uint values[]; };
layout(std430) writeonly buffer vf_emitted { Proxy emitted[]; };

uniform int triangle_count;
uniform int proxy_capacity;
uniform float disc_scale = 1.0; //! [0.25, 16] a disc's area as a multiple of the area that its proxy stands for

// Radical inverses in base 2 and 3.
vec2 halton(uint i) {
    float third = 0.0, share = 1.0 / 3.0;
    for (uint k = i; k > 0u; k /= 3u, share /= 3.0)
        third += share * float(k % 3u);
    return vec2(float(bitfieldReverse(i) >> 8) / 16777216.0, third);
}

// The last triangle whose proxies start at or before `place`.
uint triangle_of(uint place) {
    uint low = 0u, high = uint(triangle_count);
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (values[middle] <= place) low = middle;
        else high = middle;
    }
    return low;
}

void main() {
    uint place = gl_GlobalInvocationID.x, total = values[triangle_count];
    if (place >= uint(proxy_capacity)) return;
    if (place == 0u) {
        grid.proxies = total;
        grid.dropped = total > uint(proxy_capacity) ? total - uint(proxy_capacity) : 0u;
    }
    Proxy proxy = Proxy(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), k_no_cell);
    if (place >= total) {
        emitted[place] = proxy;
        return;
    }
    uint triangle = triangle_of(place), first = values[triangle], own = values[triangle + 1u] - first;
    WorldTriangle t = world_triangle(triangle);
    vec2 u = halton(place - first + 1u + (t.hash & 1023u));
    if (u.x + u.y > 1.0) u = 1.0 - u;
    vec3 e1 = t.positions[1] - t.positions[0], e2 = t.positions[2] - t.positions[0];
    proxy.position = t.positions[0] + u.x * e1 + u.y * e2;
    proxy.area = t.area * grid.density >= 1.0 ? t.area / float(own) : 1.0 / grid.density;
    proxy.radius = sqrt(disc_scale * proxy.area / 3.14159265359);
    Vertex corners[3] = Vertex[3](vertices[indices[t.first]], vertices[indices[t.first + 1u]], vertices[indices[t.first + 2u]]);
    vec3 normal = unit_or_zero(cross(e1, e2));
    vec3 authored = mat3(draws[t.draw].normal_matrix) * (corners[0].normal_v.xyz + corners[1].normal_v.xyz + corners[2].normal_v.xyz);
    proxy.normal = dot(normal, authored) < 0.0 ? -normal : normal;
    // Textures are averaged over the area that the proxy stands for.
    Material material = materials[draws[t.draw].material];
    TrianglePoint point = triangle_point_of(corners, vec3(1.0 - u.x - u.y, u), 2.0 * t.area / proxy.area);
    vec3 base = material.base_colour.rgb * point.colour.rgb * sample_at_point(material.base_colour_texture, point, 12.0).rgb;
    float metallic = clamp(material.metallic * sample_at_point(material.metallic_roughness_texture, point, 12.0).b, 0.0, 1.0);
    proxy.albedo = base * (1.0 - metallic);

    ivec3 cell = ivec3(floor((proxy.position - grid.origin) / grid.cell));
    if (in_grid(cell, grid.size)) proxy.cell = cell_index(cell, grid.size);
    else atomicAdd(grid.outside, 1u);
    if (alpha_matters(material) && !surface_is_there(material, alpha_of(material, point), hash_combine(t.hash, place - first))) {
        proxy.cell = k_no_cell;
        atomicAdd(grid.transparent, 1u);
    }
    emitted[place] = proxy;
}
