#ifndef LDM_TRACE_GLSL
#define LDM_TRACE_GLSL
// trace(x, d) in a layered depth map (LDM, section 3.1): the texel that x projects to, the node that is x's own surface,
// and its neighbours in the list: the surfaces next to x against and along the view, in one walk.
#include "ldm/walk.glsl"

uniform int own_surface = 0;      //! {tolerance, nearest} x's own surface: nodes nearer than the tolerance, or the nearest node
uniform float tolerance = 0.5;    //! [0, 8] (texels) self-intersection: nodes nearer than this along the view are x's own surface
uniform float normal_offset = 0.0; //! [0, 4] (texels) x moves off its surface by this times the sine between normal and view
uniform bool node_planes = false; //! evaluates depth on the node's plane at x (needs ldm.nodes=plane)

const float k_no_hit = 1.0e30;

// Depth of a node at `offset` texels from the texel's middle.
float ldm_depth(LdmCursor c, vec2 offset) {
    float depth = uintBitsToFloat(ldm_word(c, 0));
    if (node_planes && ldm.node_words > 2) depth += dot(unpackHalf2x16(ldm_word(c, 2)), offset);
    return depth;
}

// The neighbours of x along the view's axis: distances in metres against (x) and along (y) its direction, k_no_hit where
// there is none, and the nodes (for their slope and albedo).
struct LdmHits {
    vec2 distance;
    LdmCursor against, along;
};

LdmHits ldm_trace(int slot, LdmView view, vec3 x, vec3 normal) {
    float cosine = clamp(dot(normal, view.direction), -1.0, 1.0);
    float texel = max(view.texel.x, view.texel.y);
    LdmCursor none = LdmCursor(0u, 0u);
    LdmHits hits = LdmHits(vec2(k_no_hit), none, none);
    // What strays lies outside of the views' box, and in no map.
    vec3 place = ldm_project(view, x);
    if (any(lessThan(place, vec3(-1.0, -1.0, -0.01))) || any(greaterThan(place, vec3(vec2(ldm.resolution + 1), 1.01)))) return hits;
    vec3 p = ldm_project(view, x + normal * (normal_offset * texel * sqrt(1.0 - cosine * cosine)));
    ivec2 at = clamp(ivec2(floor(p.xy)), ivec2(0), ivec2(ldm.resolution - 1));
    vec2 offset = p.xy - (vec2(at) + 0.5);
    float apart = tolerance * texel / view.range;
    float here = p.z;

    float before = -1.0, behind = k_no_hit;
    if (own_surface == own_surface_tolerance) {
        for (LdmCursor c = ldm_first(ldm_head(slot, at)); !ldm_ended(c); c = ldm_next(c)) {
            float z = ldm_depth(c, offset);
            if (z < here - apart) {
                if (z >= before) before = z, hits.against = c;
            } else if (z > here + apart) {
                behind = z, hits.along = c;
                break;
            }
        }
    } else {
        float best = k_no_hit, last = -1.0;
        LdmCursor last_at = none;
        bool wanted = false; // the node behind the nearest so far
        for (LdmCursor c = ldm_first(ldm_head(slot, at)); !ldm_ended(c); c = ldm_next(c)) {
            float z = ldm_depth(c, offset), d = abs(z - here);
            if (wanted) behind = z, hits.along = c, wanted = false;
            if (d < best) {
                best = d, before = last, hits.against = last_at, behind = k_no_hit, wanted = true;
            } else if (z > here) {
                break;
            }
            last = z, last_at = c;
        }
    }
    if (before >= 0.0) hits.distance.x = max(here - before, 0.0) * view.range;
    if (behind < k_no_hit) hits.distance.y = max(behind - here, 0.0) * view.range;
    return hits;
}
#endif
