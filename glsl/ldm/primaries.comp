// Primary photons (LDM, section 4.2, steps 1 to 3): one per texel of each light's reflective shadow map.
// The flux through a texel of a perspective map at (a, b, 1)·d_z is I·ω, ω = pitch²/|d̂|³ with d̂ = (a, b, 1); the
// differentials start at the map's pitch and are transferred to the surface. Of a directional light, whose map is
// orthographic, photons are parallel, and the flux through a texel is E times its area. What is split off is ρ·Φ, shared by
// cosine:
//   exact: ρ·Φ·cosθ_o/Σcos over the N axes, so that nothing is lost;  published: ρ·Φ·2cosθ_o/N.
// The map holds ρ·E·⟨n·l⟩/π and ⟨n·l⟩: ρ·E = π·radiance/⟨n·l⟩, and ρ·I = ρ·E·d².
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "lib/shadow.glsl"
#include "ldm/photon.glsl"
#include "ldm/views.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray rsm_radiance;
uniform sampler2DArray rsm_normal;
uniform sampler2DArray rsm_depth;
layout(std430) readonly buffer rsm_views { ShadowView light_views[]; };
layout(std430) writeonly buffer photons_emitters { Emitter emitters[]; };

uniform bool exact_split = false; //! divides a photon's flux by the sum of cosines instead of N/2

// Whether another view of the same point light shows this direction better.
bool outside_window(ShadowView view, vec2 ndc) {
    return any(greaterThan(abs(ndc), vec2(view.window)));
}

void main() {
    ivec3 size = textureSize(rsm_depth, 0), texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size))) return;
    Emitter emitter = Emitter(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    ShadowView view = light_views[texel.z];
    float depth = texelFetch(rsm_depth, texel, 0).r;
    vec4 radiance = texelFetch(rsm_radiance, texel, 0);
    vec2 ndc = (vec2(texel.xy) + 0.5) / vec2(size.xy) * 2.0 - 1.0;
    if (depth > 0.0 && radiance.a > 1.0e-3 && !outside_window(view, ndc)) {
        bool parallel = view.range > 0.0;
        vec3 right, up;
        view_axes(view, right, up);
        vec3 aside = ndc.x * right + ndc.y * up, ray = view.direction + (parallel ? vec3(0.0) : aside);
        float distance_along = shadow_distance(view, depth), stretch = length(ray), t = distance_along * stretch;
        vec3 d = ray / stretch, n = normalize(texelFetch(rsm_normal, texel, 0).xyz);
        // d = ray/|ray|: its derivative by a step of one texel, across d.
        vec3 step_u = right * (2.0 / float(size.x)), step_v = up * (2.0 / float(size.y));
        vec3 du = (step_u - d * dot(d, step_u)) / stretch, dv = (step_v - d * dot(d, step_v)) / stretch;
        vec3 from_u = vec3(0.0), from_v = vec3(0.0); // differentials where they start
        if (parallel) {
            du = dv = vec3(0.0);
            from_u = step_u;
            from_v = step_v;
        }
        // What a texel's beam covers across itself at the surface, m².
        float area = view.texel_size * view.texel_size * (parallel ? 1.0 : t * t / (stretch * stretch * stretch));
        emitter.position = view.origin + distance_along * ray + (parallel ? aside : vec3(0.0));
        emitter.pitch_texel = view.texel_size * (parallel ? 1.0 : distance_along);
        emitter.normal = n;
        emitter.incoming = vec4(-d, 0.0);
        emitter.du_direction = vec4(du, 0.0);
        emitter.dv_direction = vec4(dv, 0.0);
        emitter.du_position = vec4(transferred(from_u, du, t, d, n), 0.0);
        emitter.dv_position = vec4(transferred(from_v, dv, t, d, n), 0.0);
        float cosines = 0.5 * float(ldm.maps);
        if (exact_split) {
            cosines = 0.0;
            for (int i = 0; i < ldm.maps; ++i)
                cosines += abs(dot(n, views[i].direction));
        }
        emitter.flux = radiance.rgb * (3.14159265359 * area / radiance.a / max(cosines, 1.0e-6));
    }
    emitters[(texel.z * size.y + texel.y) * size.x + texel.x] = emitter;
}
