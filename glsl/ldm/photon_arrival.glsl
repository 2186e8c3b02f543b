#ifndef LDM_PHOTON_ARRIVAL_GLSL
#define LDM_PHOTON_ARRIVAL_GLSL
// Steps 4a to 4d of the photon tracing (LDM, section 4.2): one photon of an emitter along one axis: traced in the map,
// rejected where the camera does not see it arrive, reflected and transferred.
//
// More bounces (section 6): a photon that arrived is split again, over a few axes of the same batch (which spread over the
// whole sphere). A path is a number: 0 ends at the first arrival; 1 … S took one of S axes more; then come the S·T that
// took one of T more after that.
#include "lib/frame.glsl"
#include "lib/material_model.glsl"
#include "ldm/trace.glsl"
#include "ldm/photon.glsl"

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;

uniform int visibility = 0;           //! {depth, plane} a photon is seen if it is near the pixel's depth, or near the pixel's plane
uniform float visibility_distance = 0.005; //! [1e-5, 0.5] that distance, as a share of the scene's diagonal
uniform float guard_band = 0.0;       //! [0, 0.5] border around the picture in which photons still count, share of its size
uniform bool snap = false;            //! moves photons onto their pixel's plane when it is within a texel of the depth
uniform float footprint_scale = 1.0;  //! [0.25, 8] footprints are as many times as long and wide as the photon's differential
uniform float region_spread = 0.0;    //! [0, 4] widens footprints with distance by this share of an axis's region, √(2π/N)
uniform float footprint_limit = 0.25; //! [0.001, 10] longest side of a footprint, as a share of the scene's diagonal
uniform int footprint_excess = 0;     //! {discard, shrink} what becomes of photons with a longer one

uniform int second_axes, third_axes; // S and T: axes of the second and the third split; 0: there is none

const uint k_outcome_none = 0u;     // no light, or the surface faces the other way
const uint k_outcome_left = 1u;     // met nothing
const uint k_outcome_unseen = 2u;   // arrived where the camera does not see it
const uint k_outcome_too_wide = 3u; // footprint beyond the limit
const uint k_outcome_arrived = 4u;

// A photon on its way: its direction, how far it goes, the node that it meets.
struct Leg {
    vec3 d;
    float cosine, t;
    LdmCursor node;
};

uint photon_leg(Emitter emitter, int slot, LdmView view, out Leg leg) {
    float side = dot(emitter.normal, view.direction);
    leg = Leg(side > 0.0 ? view.direction : -view.direction, abs(side), k_no_hit, LdmCursor(0u, 0u));
    if (emitter.pitch_texel <= 0.0 || leg.cosine < 1.0e-5) return k_outcome_none;
    LdmHits hits = ldm_trace(slot, view, emitter.position, emitter.normal);
    leg.t = side > 0.0 ? hits.distance.y : hits.distance.x;
    if (leg.t >= k_no_hit) return k_outcome_left;
    if (side > 0.0) leg.node = hits.along;
    else leg.node = hits.against;
    return k_outcome_arrived;
}

// Axis `part` of `parts` that a batch's maps are thinned out to.
int thinned_slot(int part, int parts, int maps) {
    return (2 * part + 1) * maps / (2 * parts);
}

// Where a photon arrived, as the place where it is split over `parts` axes. Normal and albedo are the node's.
Emitter split_again(Emitter emitter, Leg leg, LdmView view, int batch, int parts) {
    vec2 slope = unpackHalf2x16(ldm_word(leg.node, 2));
    vec3 n = normalize(view.to_z.xyz - slope.x * view.to_x.xyz - slope.y * view.to_y.xyz);
    if (dot(n, leg.d) > 0.0) n = -n;
    float cosines = 0.0;
    int maps = batch_maps(batch);
    for (int i = 0; i < parts; ++i)
        cosines += abs(dot(n, views[batch + thinned_slot(i, parts, maps) * ldm.batches].direction));
    Emitter next = emitter;
    next.position = emitter.position + leg.t * leg.d;
    next.normal = n;
    next.flux = emitter.flux * leg.cosine * mean_diffuse_share() * unpackUnorm4x8(ldm_word(leg.node, 3)).rgb / max(cosines, 1.0e-6);
    next.incoming = vec4(-leg.d, 0.0);
    next.du_direction.xyz = rotated(emitter.incoming.xyz, leg.d, emitter.du_direction.xyz);
    next.dv_direction.xyz = rotated(emitter.incoming.xyz, leg.d, emitter.dv_direction.xyz);
    next.du_position.xyz = transferred(emitter.du_position.xyz, next.du_direction.xyz, leg.t, leg.d, n);
    next.dv_position.xyz = transferred(emitter.dv_position.xyz, next.dv_direction.xyz, leg.t, leg.d, n);
    return next;
}

uint last_leg(Emitter emitter, int slot, LdmView view, out Photon photon) {
    photon = Photon(vec3(0.0), 0.0, vec3(0.0), 0.0, vec4(0.0), vec4(0.0));
    Leg leg;
    uint outcome = photon_leg(emitter, slot, view, leg);
    if (outcome != k_outcome_arrived) return outcome;
    vec3 d = leg.d;
    float t = leg.t;
    vec3 x = emitter.position + t * d;

    vec3 at = project_to_pixel(x);
    vec2 beside = guard_band * vec2(resolution);
    if (at.z <= near_plane || any(lessThan(at.xy, -beside)) || any(greaterThanEqual(at.xy, vec2(resolution) + beside))) return k_outcome_unseen;
    ivec2 pixel = clamp(ivec2(floor(at.xy)), ivec2(0), resolution - 1);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) return k_outcome_unseen;
    vec3 seen = world_position(pixel, depth), n = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    float off = visibility == visibility_depth ? abs(near_plane / depth - at.z) : abs(dot(seen - x, n)), cosine = -dot(d, n);
    if (off > visibility_distance * scene_diagonal || cosine <= 1.0e-3) return k_outcome_unseen;
    if (snap) {
        float beyond = dot(seen - x, n) / dot(d, n);
        if (abs(beyond) < max(view.texel.x, view.texel.y) / max(cosine, 0.05)) x += beyond * d, t += beyond;
    }

    // Diffuse reflection turns the directions' differentials as it turns ω_i to ω_o; the positions' stay.
    vec3 du = rotated(emitter.incoming.xyz, d, emitter.du_direction.xyz), dv = rotated(emitter.incoming.xyz, d, emitter.dv_direction.xyz);
    du = footprint_scale * transferred(emitter.du_position.xyz, du, t, d, n);
    dv = footprint_scale * transferred(emitter.dv_position.xyz, dv, t, d, n);
    float spread = region_spread * t * sqrt(6.28318530718 / float(ldm.maps));
    du *= sqrt(1.0 + spread * spread / max(dot(du, du), 1.0e-20));
    dv *= sqrt(1.0 + spread * spread / max(dot(dv, dv), 1.0e-20));
    float limit = footprint_limit * scene_diagonal, long_u = length(du), long_v = length(dv);
    if (max(long_u, long_v) > limit) {
        if (footprint_excess == footprint_excess_discard) return k_outcome_too_wide;
        du *= min(1.0, limit / long_u);
        dv *= min(1.0, limit / long_v);
    }
    vec3 across = cross(du, dv);
    float area = 0.25 * 3.14159265359 * length(across);
    if (!(area > 0.0)) return k_outcome_too_wide;
    bool turned = dot(across, d) > 0.0; // du × dv is to face where the photon came from
    photon.position = x;
    photon.area = area;
    photon.flux = emitter.flux * leg.cosine;
    photon.du = vec4(turned ? dv : du, 0.0);
    photon.dv = vec4(turned ? du : dv, 0.0);
    return k_outcome_arrived;
}

// What becomes of the photon of an emitter along the axis of `slot` and then along `path`.
uint photon_arrival(Emitter emitter, int batch, int slot, int path, out Photon photon) {
    photon = Photon(vec3(0.0), 0.0, vec3(0.0), 0.0, vec4(0.0), vec4(0.0));
    int maps = batch_maps(batch), legs = path == 0 ? 0 : (path <= second_axes ? 1 : 2);
    int second = legs == 1 ? path - 1 : (path - 1 - second_axes) / max(third_axes, 1);
    int third = legs == 2 ? (path - 1 - second_axes) % max(third_axes, 1) : 0;
    for (int i = 0; i < legs; ++i) {
        LdmView view = views[batch + slot * ldm.batches];
        Leg leg;
        uint outcome = photon_leg(emitter, slot, view, leg);
        if (outcome != k_outcome_arrived) return outcome;
        int parts = i == 0 ? second_axes : third_axes;
        emitter = split_again(emitter, leg, view, batch, parts);
        slot = thinned_slot(i == 0 ? second : third, parts, maps);
    }
    return last_leg(emitter, slot, views[batch + slot * ldm.batches], photon);
}
#endif
