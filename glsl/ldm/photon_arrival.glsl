#ifndef LDM_PHOTON_ARRIVAL_GLSL
#define LDM_PHOTON_ARRIVAL_GLSL
// Steps 4a to 4d of the photon tracing (LDM, section 4.2): one photon of an emitter along one axis: traced in the map,
// rejected where the camera does not see it arrive, reflected and transferred.
#include "lib/frame.glsl"
#include "ldm/trace.glsl"
#include "ldm/photon.glsl"

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;

uniform int visibility = 0;           //! {depth, plane} how far what the camera sees may lie from where the photon arrived: along the view, or off the pixel's plane
uniform float visibility_distance = 0.005; //! [1e-5, 0.5] that distance, as a share of the scene's diagonal
uniform bool snap = false;            //! photons arrive on the plane of the pixel that they project to, where that lies within a texel of the map's depth
uniform float footprint_scale = 1.0;  //! [0.25, 8] footprints are as many times as long and wide as the photon's differential
uniform float footprint_limit = 0.25; //! [0.001, 10] longest side of a footprint, as a share of the scene's diagonal
uniform int footprint_excess = 0;     //! {discard, shrink} what becomes of photons with a longer one

const uint k_fate_none = 0u;     // no light, or the surface faces the other way
const uint k_fate_left = 1u;     // met nothing
const uint k_fate_unseen = 2u;   // arrived where the camera does not see it
const uint k_fate_too_wide = 3u; // footprint beyond the limit
const uint k_fate_arrived = 4u;

uint photon_arrival(Emitter emitter, int slot, LdmView view, out Photon photon) {
    photon = Photon(vec3(0.0), 0.0, vec3(0.0), 0.0, vec4(0.0), vec4(0.0));
    float side = dot(emitter.normal, view.direction);
    if (emitter.pitch_texel <= 0.0 || abs(side) < 1.0e-5) return k_fate_none;
    vec3 d = side > 0.0 ? view.direction : -view.direction;
    vec2 both = ldm_trace(slot, view, emitter.position, emitter.normal).distance;
    float t = side > 0.0 ? both.y : both.x;
    if (t >= k_no_hit) return k_fate_left;
    vec3 x = emitter.position + t * d;

    vec3 at = project_to_pixel(x);
    ivec2 pixel = ivec2(floor(at.xy));
    if (at.z <= near_plane || any(lessThan(at.xy, vec2(0.0))) || any(greaterThanEqual(pixel, resolution))) return k_fate_unseen;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return k_fate_unseen;
    vec3 seen = world_position(pixel, depth), n = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    float off = visibility == 0 ? abs(near_plane / depth - at.z) : abs(dot(seen - x, n)), cosine = -dot(d, n);
    if (off > visibility_distance * scene_diagonal || cosine <= 1.0e-3) return k_fate_unseen;
    if (snap) {
        float beyond = dot(seen - x, n) / dot(d, n);
        if (abs(beyond) < max(view.texel.x, view.texel.y) / max(cosine, 0.05)) x += beyond * d, t += beyond;
    }

    // Diffuse reflection turns the directions' differentials as it turns ω_i to ω_o; the positions' stay.
    vec3 du = rotated(emitter.incoming.xyz, d, emitter.du_direction.xyz), dv = rotated(emitter.incoming.xyz, d, emitter.dv_direction.xyz);
    du = footprint_scale * transferred(emitter.du_position.xyz, du, t, d, n);
    dv = footprint_scale * transferred(emitter.dv_position.xyz, dv, t, d, n);
    float limit = footprint_limit * scene_diagonal, long_u = length(du), long_v = length(dv);
    if (max(long_u, long_v) > limit) {
        if (footprint_excess == 0) return k_fate_too_wide;
        du *= min(1.0, limit / long_u);
        dv *= min(1.0, limit / long_v);
    }
    vec3 across = cross(du, dv);
    float area = 0.25 * 3.14159265359 * length(across);
    if (!(area > 0.0)) return k_fate_too_wide;
    bool turned = dot(across, d) > 0.0; // du × dv is to face where the photon came from
    photon.position = x;
    photon.area = area;
    photon.flux = emitter.flux * abs(side);
    photon.du = vec4(turned ? dv : du, 0.0);
    photon.dv = vec4(turned ? du : dv, 0.0);
    return k_fate_arrived;
}
#endif
