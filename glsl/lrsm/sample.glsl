#ifndef LRSM_SAMPLE_GLSL
#define LRSM_SAMPLE_GLSL
// Light sent on by the surfaces inside one sphere of a cone, from layered reflective shadow maps.
// As published (Algorithm 1, Eq. 8–15): L = Σ_layers f(z_c)·A·R·V·N, over the layers whose depth range holds z_c.
// lit_fraction replaces it by the share of what blocks the cone that is lit. Solid angle seen from the light, divided by
// ⟨n·l⟩, is surface; times ⟨n·v⟩ it is surface as the cone sees it, so with w = V·⟨n·v⟩/⟨n·l⟩
//   L = (Σ A·R·w / Σ A·w) · min(1, Σ A·w / α),   α the sphere's occlusion.
#ifndef SEE_LAYER // what a view of the cones is told of each layer that light is taken from
#define SEE_LAYER(level)
#endif
#include "surface/rsm_views.glsl"
#include "lrsm/partition.glsl"

uniform int estimator = 0;               //! {published, lit_fraction} how a sphere's light is found
uniform bool normalised_normals = false; //! N from the filtered normal's direction alone, not its length
uniform bool layers_by_sphere = false;   //! every layer that the sphere overlaps, instead of those that hold its centre
uniform float depth_window = 1.0;        //! [0.25, 4] V's range as a multiple of the sphere's radius
uniform float smallest_sigma = 0.004;    //! [0, 0.1] floor of the depth's standard deviation, as a share of the layer's range
uniform float finest_mip = 0.0;          //! [0, 10] mips of the layers finer than this one are not used (Fig. 8)
uniform float smallest_cosine = 0.05;    //! [0.001, 1] lit_fraction: floor of ⟨n·l⟩
uniform bool formula_for_cdf = false;    //! static Φ by a formula instead of the table

#ifndef WALKS_OVER_MAPS // lrsm/cone.glsl
uniform sampler2DArray lrsm_radiance; // R·α, ⟨n·l⟩·α
uniform sampler2DArray lrsm_normal;   // n·α, α
uniform sampler2DArray lrsm_depth;    // z·α, z²·α, α; z warped to its layer
layout(std430) readonly buffer lrsm_partitions { Partition partitions[]; };
layout(std430) readonly buffer lrsm_table { int table[]; };
#if !formula_for_cdf
uniform sampler2D lrsm_normal_table; // Φ over [−4, 4]
#endif

// Φ(x): the table, linearly between its entries; or the logistic approximation of Bowling et al. 2009 (error < 1.4e-4).
float normal_cdf(float x) {
#if formula_for_cdf
    return 1.0 / (1.0 + exp(-x * (1.5976 + 0.07056 * x * x)));
#else
    float size = float(textureSize(lrsm_normal_table, 0).x);
    float at = (clamp(x, -4.0, 4.0) + 4.0) / 8.0 * (size - 1.0) + 0.5;
    return textureLod(lrsm_normal_table, vec2(at / size, 0.5), 0.0).r;
#endif
}

// Eq. 12, in warped units.
float mass_between(float mean, float variance, float from, float to) {
    float sigma = max(sqrt(max(variance, 0.0)), max(smallest_sigma, 1.0e-6));
    return normal_cdf((to - mean) / sigma) - normal_cdf((from - mean) / sigma);
}

// Where a sphere lies in one view: texture coordinates, depth along the view, and the mip whose texels are as wide as it.
struct SphereInMap {
    vec2 uv;
    float z;
    float level;
};

bool sphere_in_map(ShadowView view, vec3 centre, float radius, out SphereInMap at) {
    vec4 clip = view.view_projection * vec4(centre, 1.0);
    at.z = dot(centre - view.origin, view.direction);
    vec2 plane = clip.xy / clip.w;
    at.uv = plane * 0.5 + 0.5;
    if (clip.w <= 0.0 || at.z <= 0.0) return false;
    // Each sphere counts in one view of a light: the six of a point light overlap.
    if (max(abs(plane.x), abs(plane.y)) > view.window) return false;
    float texel = view.texel_size * (view.range > 0.0 ? 1.0 : at.z);
    // The layers' mip 0 is the map's mip 1.
    at.level = max(log2(max(2.0 * radius / texel, 1.0)) - 1.0, finest_mip);
    return true;
}

// `to_viewer`: from the sphere to the cone's apex. `alpha`: the sphere's occlusion; below 0: the sphere lies on a surface
// that blocks the whole cone, which covers the share ⟨n·v⟩ of the sphere's section.
// published: Σ f·A·R·V·N; lit_fraction: (Σ A·R·w / Σ A·w, Σ A·w). `facing`: the mean of N over what is lit.
vec4 sample_sums(int view_index, vec3 centre, float radius, vec3 to_viewer, out float mean_facing) {
    mean_facing = 1.0;
    SphereInMap at;
    if (!sphere_in_map(views[view_index], centre, radius, at)) return vec4(0.0);
    Partition p = partitions[view_index];
    vec3 radiance = vec3(0.0); // Σ f·A·R·V·N, or Σ A·R·w
    float weight = 0.0;        // Σ A·w
    vec2 facing_sum = vec2(0.0); // Σ A·V·N, Σ A·V
    for (int d = 0; d < p.depth_layers; ++d) {
        vec2 range = layer_range(p, d);
        float slack = layers_by_sphere ? depth_window * radius : 0.0;
        // The ends are open: beyond them there is nothing that another layer could hold.
        if ((at.z + slack < range.x && d > 0) || (at.z - slack > range.y && d + 1 < p.depth_layers)) continue;
        float extent = max(range.y - range.x, 1.0e-20);
        float from = (at.z - depth_window * radius - range.x) / extent, to = (at.z + depth_window * radius - range.x) / extent;
        // Where two layers overlap both hold the texels: each counts by its decay at the texels' depth.
        float decay = layers_by_sphere ? 1.0 : layer_decay(p, d, at.z);
        for (int n = 0; n < k_max_normal_layers; ++n) {
            int place = table[table_index(view_index, d, n)];
            if (place < 0) continue;
            vec4 normal = textureLod(lrsm_normal, vec3(at.uv, float(place)), at.level);
            if (normal.a <= 1.0e-4) continue;
            vec3 mean_normal = normal.xyz / normal.a;
            float length_squared = dot(mean_normal, mean_normal);
            if (normalised_normals && length_squared > 0.0) mean_normal *= inversesqrt(length_squared);
            float facing = dot(mean_normal, to_viewer); // N, Eq. 8
            if (facing <= 0.0) continue;
            vec4 moments = textureLod(lrsm_depth, vec3(at.uv, float(place)), at.level);
            if (moments.b <= 1.0e-4) continue;
            float mean = moments.r / moments.b;
            float inside = mass_between(mean, moments.g / moments.b - mean * mean, from, to); // V, Eq. 12
            if (inside <= 0.0) continue;
            SEE_LAYER(at.level);
            if (layers_by_sphere) decay = layer_decay(p, d, range.x + mean * extent);
            vec4 lit = textureLod(lrsm_radiance, vec3(at.uv, float(place)), at.level); // A·R, A·⟨n·l⟩
            if (estimator == estimator_published) {
                radiance += decay * inside * facing * lit.rgb;
            } else {
                float w = decay * inside * facing / max(lit.a / normal.a, smallest_cosine);
                radiance += w * lit.rgb;
                weight += w * normal.a;
                facing_sum += decay * inside * normal.a * vec2(facing, 1.0);
            }
        }
    }
    mean_facing = facing_sum.x / max(facing_sum.y, 1.0e-6);
    if (estimator == estimator_published) return vec4(radiance, 0.0);
    return weight > 0.0 ? vec4(radiance / weight, weight) : vec4(0.0);
}

// `to_viewer`: from the sphere to the cone's apex. `alpha`: the sphere's occlusion; below 0: the sphere lies on a surface
// that blocks the whole cone, which covers the share ⟨n·v⟩ of the sphere's section.
vec3 sample_view(int view_index, vec3 centre, float radius, vec3 to_viewer, float alpha) {
    float mean_facing;
    vec4 lit = sample_sums(view_index, centre, radius, to_viewer, mean_facing);
    if (estimator == estimator_published) return lit.rgb;
    return lit.rgb * min(1.0, lit.a / max(alpha < 0.0 ? mean_facing : alpha, 1.0e-3));
}

// Light of what is lit inside a sphere, and in a the share of its section that it covers.
vec4 sample_lit(int view_index, vec3 centre, float radius, vec3 to_viewer) {
    float mean_facing;
    vec4 lit = sample_sums(view_index, centre, radius, to_viewer, mean_facing);
    lit.a = min(lit.a, 1.0);
    return vec4(lit.rgb * lit.a, lit.a);
}
#endif

#endif
