#ifndef TRACED_TRACE_GLSL
#define TRACED_TRACE_GLSL
// Rays against the scene's triangles: the nearest hit, or whether there is any. Both sides count. Surfaces with alpha
// are there as lib/coverage.glsl says; blended ones by a draw of its own for each ray and triangle.
#include "traced/alpha.glsl"
#include "traced/walk.glsl"

// Of two triangles in one place the first of the scene is hit, whatever the tree.
bool is_before(TracedHit a, TracedHit b) {
    return a.t < b.t || (a.t == b.t && (a.draw < b.draw || (a.draw == b.draw && a.corner < b.corner)));
}

// A ray's own axes across its direction (Woop, Benthin, Wald, "Watertight ray/triangle intersection", JCGT 2013): dot
// products with these take what leads from the origin to a point there. Their entries are 0, 1 and one shear each.
struct RayAxes {
    vec3 origin, x, y, direction;
};

RayAxes axes_of(vec3 origin, vec3 direction) {
    vec3 size = abs(direction);
    int k = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    vec3 x = vec3(k == 2, k == 0, k == 1), y = vec3(k == 1, k == 2, k == 0), z = vec3(k == 0, k == 1, k == 2);
    float along = dot(direction, z);
    return RayAxes(origin, x - z * (dot(direction, x) / along), y - z * (dot(direction, y) / along), direction);
}

// A triangle of three texels from `at` on. Rays do not slip between neighbours, nor through their corners: each corner has
// the same two coordinates for all its triangles, and the sign of a difference of products is never the wrong one.
bool meet_triangle(uint at, RayAxes ray, out float t, out vec2 uv, out uvec3 carried) {
    uvec4 texel0 = tree_texel(at), texel1 = tree_texel(at + 1u), texel2 = tree_texel(at + 2u);
    carried = uvec3(texel0.w, texel1.w, texel2.w);
    vec3 a = uintBitsToFloat(texel0.xyz) - ray.origin, b = uintBitsToFloat(texel1.xyz) - ray.origin, c = uintBitsToFloat(texel2.xyz) - ray.origin;
    precise float ax = dot(a, ray.x), ay = dot(a, ray.y), bx = dot(b, ray.x), by = dot(b, ray.y), cx = dot(c, ray.x), cy = dot(c, ray.y);
    precise float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax; // weights of a, b, c
    float sum = u + v + w;
    uv = vec2(v, w) / sum;
    // By the plane: far corners of a triangle that is near would cancel.
    vec3 normal = cross(b - a, c - a);
    float slope = dot(normal, ray.direction);
    t = dot(a, normal) / slope;
    return (min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0) && sum != 0.0 && slope != 0.0 && t > 0.0;
}

// One tree with the ray in its own space. `any`: the first hit that is found ends it.
void trace_tree(uint root, uint root_draw, uvec4 place, vec3 origin, vec3 direction, bool any, uint seed, inout TracedHit hit) {
    uvec4 low = tree_texel(root + 2u), scale = tree_texel(root + 3u);
    TreeWalk walk = start_walk(place.x, place.y, uintBitsToFloat(low.xyz), uintBitsToFloat(scale.xyz), origin, direction);
    RayAxes ray = axes_of(origin, direction);
    uint at = 0u, end = 0u; // texels of triangles that are still to be tested
    bool going = true;
    while (going) {
        TracedHit unsure; // whose alpha is to be looked at: outside of the inner loops, which all rays run
        uint record = 0u;
        unsure.draw = k_nothing;
        while (going && unsure.draw == k_nothing) {
            if (at == end) {
                uint leaf = next_leaf(walk, hit.t);
                at = place.z + 3u * (leaf & k_leaf_first);
                end = leaf != 0u ? at + 3u * leaf_count(leaf) : at;
                going = leaf != 0u;
            }
            while (at < end && unsure.draw == k_nothing) {
                TracedHit found;
                uvec3 carried;
                bool met = meet_triangle(at, ray, found.t, found.uv, carried);
                found.draw = root_draw == k_nothing ? carried.x : root_draw;
                found.corner = carried.y;
                if (met && is_before(found, hit)) {
#ifdef HAS_traced_alpha
                    if (carried.z != 0u) unsure = found, record = carried.z;
                    else hit = found;
#else
                    hit = found;
#endif
                }
                at += 3u;
#ifdef TRACED_COUNTS
                ++tested_triangles;
#endif
            }
            if (any && hit.draw != k_nothing) going = false;
        }
#ifdef HAS_traced_alpha
        if (unsure.draw != k_nothing && triangle_is_there(record, unsure.draw, unsure.corner, unsure.uv, seed)) {
            hit = unsure;
            going = going && !any;
        }
#endif
    }
}

// Everything on origin + t·direction, 0 < t < reach. `seed`: of the draws for blended surfaces; 0: they are there from
// alpha ½ on.
TracedHit trace(vec3 origin, vec3 direction, float reach, bool any, uint seed) {
    TracedHit hit = TracedHit(reach, k_nothing, k_nothing, vec2(0.0));
    uvec4 header = tree_texel(0u);
    TreeWalk top = start_list(header.y, header.z, uintBitsToFloat(tree_texel(1u).xyz), uintBitsToFloat(tree_texel(2u).xyz), origin, direction);
    bool going = header.x > 0u;
    while (going) {
        uint leaf = next_listed(top, hit.t);
        going = leaf != 0u;
        if (going) {
            uint root = k_header_texels + k_root_texels * (leaf & k_leaf_first);
            uvec4 place = tree_texel(root);
            uint root_draw = tree_texel(root + 1u).x;
            vec3 o = origin, d = direction;
            if ((place.w & 1u) == 0u) {
                vec4 x = uintBitsToFloat(tree_texel(root + 4u)), y = uintBitsToFloat(tree_texel(root + 5u)), z = uintBitsToFloat(tree_texel(root + 6u));
                o = vec3(dot(x, vec4(origin, 1.0)), dot(y, vec4(origin, 1.0)), dot(z, vec4(origin, 1.0)));
                d = vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction));
            }
            trace_tree(root, root_draw, place, o, d, any, seed, hit);
            going = !any || hit.draw == k_nothing;
        }
    }
    return hit;
}

TracedHit trace_nearest(vec3 origin, vec3 direction, float reach, uint seed) {
    return trace(origin, direction, reach, false, seed);
}
bool trace_any(vec3 origin, vec3 direction, float reach, uint seed) {
    return trace(origin, direction, reach, true, seed).draw != k_nothing;
}

#endif
