// Environment light from the maps of a batch (LDM, sections 3.1 and 5.2; Fig. 11), added up over the batches:
//   E/π ≈ 2/N Σ V(x, ω_i)·L_environment(ω_i)·cosθ_i,
// over the N axes, each taken in the direction that leaves the surface.
#include "lib/frame.glsl"
#include "lib/environment.glsl"
#include "ldm/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform int iteration, repeat_from;
// Σ V·L·cosθ so far; the last batch leaves E/π
layout(FORMAT_ldm_sky) uniform image2D ldm_sky; //! ordered: each invocation has its own texel

uniform bool region_mean = false; //! averages the environment over each axis's share of the sphere

// The mean over a cone as wide as an axis's region, by 16 directions on a spiral.
vec3 sky_of(vec3 direction) {
    if (!region_mean || environment_map == 0) return environment(direction);
    vec3 across = normalize(abs(direction.x) < 0.9 ? cross(direction, vec3(1.0, 0.0, 0.0)) : cross(direction, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(direction, across), sum = vec3(0.0);
    float share = 1.0 / float(ldm.maps); // of the hemisphere: 1 − cos of the cone's half angle
    for (int i = 0; i < 16; ++i) {
        float c = 1.0 - share * (float(i) + 0.5) / 16.0, s = sqrt(max(1.0 - c * c, 0.0)), a = 2.39996323 * float(i);
        sum += environment(c * direction + s * (cos(a) * across + sin(a) * up));
    }
    return sum / 16.0;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(ldm_sky);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec3 sum = iteration > repeat_from ? imageLoad(ldm_sky, texel).rgb : vec3(0.0);
    if (depth > 0.0) {
        vec3 x = world_position(pixel, depth);
        vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        int maps = batch_maps(iteration);
        for (int slot = 0; slot < maps; ++slot) {
            LdmView view = views[iteration + slot * ldm.batches];
            float cosine = dot(n, view.direction), above = dot(face, view.direction);
            if (cosine * above <= 0.0) continue; // the surface itself is in the way
            vec2 both = ldm_trace(slot, view, x, face).distance;
            if ((cosine > 0.0 ? both.y : both.x) < k_no_hit) continue;
            sum += abs(cosine) * sky_of(cosine > 0.0 ? view.direction : -view.direction);
        }
    }
    if (iteration == ldm.batches - 1) sum *= 2.0 / float(ldm.maps);
    imageStore(ldm_sky, texel, vec4(sum, 0.0));
}
