#ifndef LDM_VIEWS_GLSL
#define LDM_VIEWS_GLSL
// Views of layered depth maps, and how their lists lie in memory. passes/ldm/views.h and layered_depth_maps.cpp mirror the
// structs.
//
// Maps are built in batches: map m = batch + slot · batches lies in slot `slot` of its batch, so that each batch's
// directions spread over the whole sphere. Within a batch, `lists` holds first a head for every texel of every slot, then
// nodes of `node_words` words:
//   depth (float bits; never negative, so they sort as integers) · link · [slope (2 × half, depth a texel)] · [albedo]
// A head or link is the number of a node, counted from 1; 0 ends the list.
struct LdmView {
    vec4 to_x, to_y, to_z; // world (x, 1) → texel coordinates, and depth 0 … 1
    vec3 direction;        // the way the view looks
    float range;           // metres of depth 0 … 1
    vec2 texel;            // metres
    vec2 padding;
};

struct LdmInfo {
    int maps;       // N
    int resolution; // texels a side
    int batches;
    int slots;      // maps in a full batch
    int heads;      // slots · resolution²
    int node_words; // 2: depth and link · 3: with slopes · 4: with albedo
    int capacity;   // nodes
    int arrays;     // 1: ldm.arrays holds the depths in order, without links
};

#ifndef WITHOUT_LDM_VIEWS
layout(std430) readonly buffer ldm_views { LdmView views[]; };
#endif
layout(std430) readonly buffer ldm_info { LdmInfo ldm; };

// Maps of a batch.
int batch_maps(int batch) {
    return max((ldm.maps - batch + ldm.batches - 1) / ldm.batches, 0);
}

// Texel coordinates and depth.
vec3 ldm_project(LdmView view, vec3 x) {
    vec4 p = vec4(x, 1.0);
    return vec3(dot(view.to_x, p), dot(view.to_y, p), dot(view.to_z, p));
}

int ldm_head(int slot, ivec2 texel) {
    return (slot * ldm.resolution + texel.y) * ldm.resolution + texel.x;
}
#endif
