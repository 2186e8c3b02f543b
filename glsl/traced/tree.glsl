#ifndef TRACED_TREE_GLSL
#define TRACED_TREE_GLSL
// Where trees lie: texels of 16 bytes, in a texture or in a buffer. passes/traced/tree_layout.h tells of nodes and
// triangles, passes/traced/scene_trees.cpp of the header and the roots.
uniform bool wide_nodes = false; //! static nodes of four children and a short stack, for GPUs; off: of one, without a stack

#if wide_nodes
layout(std430) readonly buffer traced_nodes { uvec4 tree_texels[]; };
uvec4 tree_texel(uint i) {
    return tree_texels[i];
}
#else
layout(FORMAT_traced_tree) readonly uniform uimage2D traced_tree; // an image: software drivers read it with less ado
uvec4 tree_texel(uint i) {
    return imageLoad(traced_tree, ivec2(i & 8191u, i >> 13));
}
#endif

const uint k_leaf_bit = 1u << 29;
const uint k_leaf_first = (1u << 26) - 1u; // mask
const uint k_header_texels = 3u, k_root_texels = 7u;

uint leaf_count(uint word) {
    return ((word >> 26) & 7u) + 1u;
}

// A direction by which one can divide.
vec3 without_zeros(vec3 d) {
    const float k_least = 1.0e-20;
    return mix(d, mix(vec3(k_least), vec3(-k_least), lessThan(d, vec3(0.0))), lessThan(abs(d), vec3(k_least)));
}

uint octant_of(vec3 d) {
    uvec3 negative = uvec3(lessThan(d, vec3(0.0)));
    return negative.x | (negative.y << 1) | (negative.z << 2);
}

#endif
