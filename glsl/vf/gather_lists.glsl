#ifndef VF_GATHER_LISTS_GLSL
#define VF_GATHER_LISTS_GLSL
// Indirect light at the gather's own resolution (VF, section 3.3): a texel merges the lists of the four texels of the low
// resolution around it, each weighted by where it lies and by how well its surface agrees (Eq. 5: N_c is the sum of these
// weights), and adds up the cells of the merged list: near ones proxy by proxy, far ones by spherical harmonics (Eq. 6).
// Define GLOSS for glossy instead of diffuse light.
#include "lib/frame.glsl"
#include "lib/specular_albedo.glsl"
#include "lib/interleave.glsl"
#include "surface/start.glsl"
#include "vf/emitters.glsl"
#include "vf/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) readonly buffer vf_ranges { uvec2 ranges[]; };
layout(std430) readonly buffer vf_proxies { Proxy proxies[]; };
layout(std430) readonly buffer vf_light { ProxyLight lit[]; };
layout(std430) readonly buffer vf_cells { Cell cells[]; };
layout(std430) readonly buffer vf_filtered { uint filtered[]; };
layout(std430) readonly buffer vf_sizes { ivec2 march_size; int list_capacity, filtered_capacity; };
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_roughness_metallic;
#ifdef GLOSS
layout(FORMAT_vf_gloss) writeonly uniform image2D vf_gloss;
#else
layout(FORMAT_vf_irradiance) writeonly uniform image2D vf_irradiance;
#endif

uniform float near = 2.0;         //! [0, 1000] (cells) R: cells whose light is nearer count proxy by proxy
uniform int interleave = 1;       //! [1, 8] (texels) neighbours in blocks of n × n take every n²-th proxy of a cell; 1: all
uniform int depth_weight = 0;     //! {depth, plane} w_G by distance along the view, or by distance to the texel's plane
uniform float depth_sigma = 0.01; //! [1e-4, 1] w_G: deviation of the depth difference, as a share of the view distance
uniform float normal_sigma = 0.2; //! [0.01, 2] w_G: deviation of 1 − ⟨n·n'⟩
#ifdef GLOSS
uniform int estimator = 0;   //! {weighted, lobe} the mean by Eq. 7 as published, or the sum by the surface's own lobe
uniform float eta = 1.0;     //! [0.1, 8] η of Eq. 7
uniform float sigma = 0.589; //! [0.01, 10] σ of Eq. 7 times Phong's exponent; 0.589: as wide at half height as cosⁿ
#endif

ivec2 gather_size() {
#ifdef GLOSS
    return imageSize(vf_gloss);
#else
    return imageSize(vf_irradiance);
#endif
}

struct Corner {
    int next, left;
    float weight;
};

// Of the texel's surface.
struct Point {
    vec3 x, n, v, reflected, base_colour;
    float roughness, metallic, exponent;
};

// Σ over what was visited: E/π, or glossy light and for Eq. 7 the sum of weights.
vec3 gathered = vec3(0.0);
float weights = 0.0;

// `light`: radiance times solid angle.
void add_light(Point p, vec3 away, vec3 light, float solid_angle, float share) {
    float cosine = dot(p.n, away);
    if (cosine <= 0.0) return;
#ifndef GLOSS
    gathered += share * k_inverse_pi * cosine * light;
#else
    if (estimator == estimator_weighted) {
        float off = 1.0 - pow(max(dot(p.reflected, away), 0.0), eta), s = sigma / p.exponent;
        float w = share * exp(-0.5 * off * off / (s * s)) / (s * 2.50662827463);
        gathered += w * light;
        weights += w * solid_angle;
    } else {
        // A disc is no point: its light is spread over its solid angle, by a wider lobe.
        float alpha = brdf_alpha(p.roughness), wider = sqrt(sqrt(alpha * alpha + 0.25 * k_inverse_pi * solid_angle));
        gathered += share * cosine * brdf_specular(p.n, p.v, away, p.base_colour, p.metallic, wider) * light;
    }
#endif
}

void add_cell(Point p, uint c, float share, float part) {
    Cell cell = cells[c];
#ifdef GLOSS
    bool asks_all = estimator == estimator_weighted; // also what is not lit: it counts as dark
#else
    bool asks_all = false;
#endif
    if (cell.c00.a <= 0.0 && !asks_all) return;
    vec3 to = cell.middle.xyz - p.x;
    float squared = dot(to, to), reach = near * (grid.cell.x + grid.cell.y + grid.cell.z) / 3.0;
    if (squared >= reach * reach) {
        vec3 away = to * inversesqrt(max(squared, 1.0e-20));
        // Of its discs half the area faces any way.
        add_light(p, away, cell_intensity(cell, -away) / squared, 0.5 * cell.middle.w / squared, share);
        return;
    }
    uvec2 range = ranges[2u * c];
    uint stride = uint(interleave * interleave);
    for (uint i = range.x + uint(part * float(stride)); i < range.y; i += stride) {
        vec3 away;
        float solid_angle;
        vec3 light = proxy_light(proxies[i], lit[i], p.x, away, solid_angle);
        if (asks_all || max(light.r, max(light.g, light.b)) > 0.0) add_light(p, away, float(stride) * light, float(stride) * solid_angle, share);
    }
}

Corner corner_of(ivec2 texel, float bilinear, StartPoint own) {
    Corner corner = Corner(0, 0, 0.0);
    ivec2 at = clamp(texel, ivec2(0), march_size - 1);
    StartPoint other;
    if (bilinear <= 0.0 || !start_at(pixel_of(at, march_size), other)) return corner;
    vec3 apart = other.position - own.position;
    float off = (depth_weight == depth_weight_plane ? dot(own.face, apart) : dot(apart, camera_forward)) / (depth_sigma * own.distance);
    float turned = (1.0 - dot(own.normal, other.normal)) / normal_sigma;
    corner.weight = bilinear * exp(-0.5 * (off * off + turned * turned));
    int from = list_start(at, march_size, filtered_capacity);
    corner.left = int(filtered[from]);
    corner.next = from + k_list_header;
    return corner;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = gather_size();
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = pixel_of(texel, size);
    StartPoint own;
    if (start_at(pixel, own)) {
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        Point p = Point(own.position, own.normal, normalize(camera_position - own.position), vec3(0.0), texelFetch(gbuffer_albedo, pixel, 0).rgb, rm.x, rm.y, 0.0);
        p.reflected = reflect(-p.v, p.n);
        float alpha = brdf_alpha(p.roughness);
        p.exponent = max(2.0 / (alpha * alpha) - 2.0, 0.1);
        float part = interleaved_part(texel, interleave);

        vec2 at = (vec2(texel) + 0.5) * vec2(march_size) / vec2(size) - 0.5;
        ivec2 low = ivec2(floor(at));
        vec2 share = at - vec2(low);
        Corner corners[4];
        float total = 0.0;
        for (int k = 0; k < 4; ++k) {
            ivec2 corner = ivec2(k & 1, k >> 1);
            vec2 bilinear = mix(1.0 - share, share, vec2(corner));
            corners[k] = corner_of(low + corner, bilinear.x * bilinear.y, own);
            total += corners[k].weight;
        }
        // Where no neighbour agrees, the one that does so best stands for all.
        if (total < 1.0e-6) {
            int best = -1;
            float most = 0.0;
            for (int k = 0; k < 4; ++k)
                if (corners[k].weight > most) most = corners[k].weight, best = k;
            for (int k = 0; k < 4; ++k)
                corners[k].weight = k == best ? 1.0 : 0.0;
            total = 1.0;
        }
        for (;;) {
            uint lowest = 0xffffffffu;
            for (int k = 0; k < 4; ++k)
                if (corners[k].left > 0) lowest = min(lowest, filtered[corners[k].next]);
            if (lowest == 0xffffffffu) break;
            float weight = 0.0;
            for (int k = 0; k < 4; ++k) {
                if (corners[k].left <= 0 || filtered[corners[k].next] != lowest) continue;
                uvec2 counted = unpacked_counts(filtered[corners[k].next + 1]);
                // As published every ray that crossed a cell saw it, and it counts wholly.
                weight += corners[k].weight * float(counted.x) / float(max(counted.y, 1u));
                corners[k].next += 2;
                --corners[k].left;
            }
            if (weight > 0.0) add_cell(p, lowest, weight / total, part);
        }
#ifdef GLOSS
        if (estimator == estimator_weighted) gathered /= max(weights, 1.0e-12);
        else gathered /= max(specular_albedo(p.base_colour, p.metallic, p.roughness, dot(p.n, p.v)), vec3(1.0e-4));
#endif
    }
    vec4 result = vec4(min(gathered, vec3(65504.0)), 1.0);
#ifdef GLOSS
    imageStore(vf_gloss, texel, result);
#else
    imageStore(vf_irradiance, texel, result);
#endif
}
#endif
