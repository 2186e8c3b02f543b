// Gloss along the nearest axis (LDM, section 6, "Non-Lambertian BRDF"): of the N axes the direction nearest to the mirror
// direction is traced, and what it meets sends on the light that the reflective shadow maps hold there (one bounce of punctual
// lights off a diffuse surface), times the directional albedo of the specular lobe. Each batch asks only for its own axes.
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "lib/brdf.glsl"
#include "lib/specular_albedo.glsl"
#include "lib/shadow.glsl"
#include "ldm/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_roughness_metallic;
uniform sampler2D gbuffer_depth;
uniform sampler2DArray rsm_radiance;
uniform sampler2DArray rsm_depth;
layout(std430) readonly buffer rsm_views { ShadowView light_views[]; };
uniform int iteration, repeat_from;
layout(FORMAT_out_indirect_specular) writeonly uniform image2D out_indirect_specular;

uniform float lit_distance = 0.01; //! [1e-4, 0.5] depth behind a shadow map that is still lit, share of the scene's diagonal

// What a surface at x sends on of the lights that see it.
vec3 sent_on(vec3 x) {
    vec3 sum = vec3(0.0);
    ivec3 size = textureSize(rsm_depth, 0);
    for (int layer = 0; layer < size.z; ++layer) {
        ShadowView view = light_views[layer];
        vec4 clip = view.view_projection * vec4(x, 1.0);
        if (clip.w <= 0.0) continue;
        vec2 ndc = clip.xy / clip.w;
        if (any(greaterThan(abs(ndc), vec2(view.window)))) continue;
        ivec3 texel = ivec3(clamp(ivec2(floor((ndc * 0.5 + 0.5) * vec2(size.xy))), ivec2(0), size.xy - 1), layer);
        float depth = texelFetch(rsm_depth, texel, 0).r;
        if (depth <= 0.0) continue;
        if (dot(x - view.origin, view.direction) < shadow_distance(view, depth) + lit_distance * scene_diagonal)
            sum += texelFetch(rsm_radiance, texel, 0).rgb;
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0 || diffuse_only != 0) return;
    vec3 x = world_position(pixel, depth), v = normalize(camera_position - x);
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), mirror = reflect(-v, n);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    // The nearest of all axes: only the batch that holds it goes on.
    int nearest = -1;
    float best = 0.0;
    for (int i = 0; i < ldm.maps; ++i) {
        float along = dot(views[i].direction, mirror);
        if (abs(along) > abs(best)) best = along, nearest = i;
    }
    if (nearest < 0 || nearest % ldm.batches != iteration) return;
    LdmView view = views[nearest];
    vec3 d = best > 0.0 ? view.direction : -view.direction;
    vec3 radiance = vec3(0.0);
    vec2 both = ldm_trace(nearest / ldm.batches, view, x, face).distance;
    float t = best > 0.0 ? both.y : both.x;
    if (dot(d, face) > 0.0 && t < k_no_hit) {
        vec2 rm = texelFetch(gbuffer_roughness_metallic, pixel, 0).rg;
        vec3 albedo = texelFetch(gbuffer_albedo, pixel, 0).rgb;
        radiance = sent_on(x + t * d) * specular_albedo(albedo, rm.y, rm.x, max(dot(n, v), 0.0));
    }
    imageStore(out_indirect_specular, pixel, vec4(min(radiance, vec3(65504.0)), 1.0));
}
