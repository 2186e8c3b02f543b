#ifndef TRACED_WALK_GLSL
#define TRACED_WALK_GLSL
// A ray's way through the nodes of one tree, from leaf to leaf, near ones first.
#include "traced/tree.glsl"

// Distances are those of the ray as it was given: its direction may have any length.
struct TreeWalk {
    vec3 origin;  // in steps of the tree's grid
    vec3 inverse; // of the direction, likewise
    uint at, end; // texels of the list that is walked along
#if wide_nodes
    uint first, octant, pending, depth;
#endif
};

#ifdef TRACED_COUNTS
int visited_nodes = 0, tested_triangles = 0;
#endif

// Rounding of a far origin moves all distances by a share of themselves.
const float k_slack = 1.000001;

TreeWalk start_list(uint first, uint nodes, vec3 low, vec3 scale, vec3 origin, vec3 direction) {
    TreeWalk walk;
    vec3 d = without_zeros(direction);
    walk.origin = (origin - low) * scale;
    walk.inverse = 1.0 / (d * scale);
    walk.at = first + octant_of(d) * nodes;
    walk.end = walk.at + nodes;
#if wide_nodes
    walk.first = first;
    walk.octant = octant_of(d);
    walk.pending = 0u;
    walk.depth = 0u;
#endif
    return walk;
}

// The next leaf's word along a threaded list; 0 at its end. `nearest`: what lies beyond does not count.
uint next_listed(inout TreeWalk walk, float nearest) {
    uint leaf = 0u;
    while (leaf == 0u && walk.at < walk.end) {
        uvec4 node = tree_texel(walk.at);
        vec3 enter = (vec3(ivec3(node.xyz & 0xffffu)) - walk.origin) * walk.inverse;
        vec3 leave = (vec3(ivec3(node.xyz >> 16)) - walk.origin) * walk.inverse;
        bool inside = max(max(enter.x, enter.y), max(enter.z, 0.0)) <= k_slack * min(min(leave.x, leave.y), min(leave.z, nearest));
        bool is_leaf = (node.w & k_leaf_bit) != 0u;
        walk.at = inside || is_leaf ? walk.at + 1u : node.w;
        if (inside && is_leaf) leaf = node.w;
#ifdef TRACED_COUNTS
        ++visited_nodes;
#endif
    }
    return leaf;
}

#if wide_nodes
const uint k_stack = 24u; // levels; half of k_max_tree_depth
uint walk_stack[k_stack];

TreeWalk start_walk(uint first, uint nodes, vec3 low, vec3 scale, vec3 origin, vec3 direction) {
    TreeWalk walk = start_list(first, nodes, low, scale, origin, direction);
    walk.at = first;
    walk.pending = 16u; // the root, whose children have not been looked at
    return walk;
}

// The children's order along the ray: the nearer pair first, in each pair the nearer one. k-th → slot.
uint slot_in_order(uvec4 words, uint octant, uint k) {
    uint pair = (k >> 1) ^ ((octant >> (words.x >> 30)) & 1u);
    return (pair << 1) | ((k & 1u) ^ ((octant >> ((pair == 0u ? words.y : words.z) >> 30)) & 1u));
}

// Which children of the node at walk.at the ray meets nearer than `nearest`; bits in the children's order.
uint children_met(TreeWalk walk, uvec4 words, float nearest) {
    vec4 enter = vec4(0.0), leave = vec4(nearest);
    for (uint axis = 0u; axis < 3u; ++axis) {
        uvec4 sides = tree_texel(walk.at + axis);
        vec4 low = (vec4(ivec4(sides & 0xffffu)) - walk.origin[axis]) * walk.inverse[axis];
        vec4 high = (vec4(ivec4(sides >> 16)) - walk.origin[axis]) * walk.inverse[axis];
        bool negative = ((walk.octant >> axis) & 1u) != 0u;
        enter = max(enter, negative ? high : low);
        leave = min(leave, negative ? low : high);
    }
    bvec4 met = lessThanEqual(enter, k_slack * leave);
    uint bits = 0u;
    for (uint k = 0u; k < 4u; ++k) bits |= met[slot_in_order(words, walk.octant, k)] ? 1u << k : 0u;
    return bits;
}

uint next_leaf(inout TreeWalk walk, float nearest) {
    uint leaf = 0u;
    while (leaf == 0u) {
        uvec4 words = tree_texel(walk.at + 3u);
        if (walk.pending == 16u) {
            walk.pending = children_met(walk, words, nearest);
#ifdef TRACED_COUNTS
            ++visited_nodes;
#endif
        }
        if (walk.pending == 0u) {
            if (walk.depth == 0u) break;
            uint entry = walk_stack[--walk.depth];
            walk.at = walk.first + (entry >> 4) * 4u;
            walk.pending = entry & 15u;
            continue;
        }
        uint slot = slot_in_order(words, walk.octant, uint(findLSB(walk.pending)));
        walk.pending &= walk.pending - 1u;
        uint word = words[slot];
        if ((word & k_leaf_bit) != 0u) {
            leaf = word & ~(3u << 30);
            continue;
        }
        if (walk.pending != 0u) walk_stack[walk.depth++] = ((walk.at - walk.first) / 4u << 4) | walk.pending;
        walk.at = word & (k_leaf_bit - 1u);
        walk.pending = 16u;
    }
    return leaf;
}
#else
TreeWalk start_walk(uint first, uint nodes, vec3 low, vec3 scale, vec3 origin, vec3 direction) {
    return start_list(first, nodes, low, scale, origin, direction);
}
uint next_leaf(inout TreeWalk walk, float nearest) {
    return next_listed(walk, nearest);
}
#endif

#endif
