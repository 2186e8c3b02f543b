// Ambient occlusion from the maps of a batch (LDM, Eq. 2 and 3), added up over the batches:
//   AO(x) ≈ 2/N Σ V(x, ω_i)·cosθ_i,
// over the N axes, each taken in the direction that leaves the surface. Red: V = 0 for any surface that is met; green: for
// one within d_max; as obscurance (falloff quadratic), V grows with the distance r to what is met instead: (r/d_max)², r < d_max.
#include "lib/frame.glsl"
#include "ldm/surface_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform int iteration, repeat_from;
layout(FORMAT_ldm_openness) uniform image2D ldm_openness; //! ordered: each invocation has its own texel // Σ V·cosθ so far

uniform float d_max = 0.1; //! [1e-4, 10] (scene diagonals) occluders further away do not count for out.ambient_occlusion_dmax
uniform int falloff = 0;   //! {none, quadratic} what lies within d_max occludes in full, or by 1 − (r/d_max)² (obscurance)

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(ldm_openness);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec2 sum = iteration > repeat_from ? imageLoad(ldm_openness, texel).rg : vec2(0.0);
    if (depth > 0.0) {
        vec3 x = world_position(pixel, depth);
        vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        float max_distance = d_max * scene_diagonal;
        int maps = batch_maps(iteration);
        for (int slot = 0; slot < maps; ++slot) {
            LdmRay ray;
            if (!ldm_surface_ray(slot, views[iteration + slot * ldm.batches], x, n, face, ray)) continue;
            float r = ray.distance;
            vec2 open = vec2(r < k_no_hit ? 0.0 : 1.0, r < max_distance ? 0.0 : 1.0);
            if (falloff == falloff_quadratic && r < max_distance) open.g = r * r / (max_distance * max_distance);
            sum += open * ray.cosine;
        }
    }
    imageStore(ldm_openness, texel, vec4(sum, 0.0, 0.0));
}
