// The boxes of a level of the trees, from the camera: of each tree the nodes `level` steps below its root, and the leaves
// above. Each has a colour of its own, shaded by the face that the ray enters. A box that holds the camera is passed by.
// a: distance to the face in metres, 0 where there is none.
#include "lib/scene.glsl"
#include "lib/coverage.glsl"
#include "lib/frame.glsl"
#include "traced/tree.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_nodes) writeonly uniform image2D debug_nodes;

uniform int level = 6; //! [0, 47] steps below the roots

const int k_stack = 192; // four children a level
uint stack[k_stack];     // texels of nodes; of the wide layout: of the node that has it, and which child it is
int levels[k_stack];

struct NodeBox {
    vec3 low, high; // steps of the grid
    bool leaf;
};

#if wide_nodes
// A node is what its parent says of it: texel and slot.
NodeBox box_of(uint entry) {
    uint at = entry >> 2, slot = entry & 3u;
    uvec3 sides = uvec3(tree_texel(at)[slot], tree_texel(at + 1u)[slot], tree_texel(at + 2u)[slot]);
    return NodeBox(vec3(sides & 0xffffu), vec3(sides >> 16), (tree_texel(at + 3u)[slot] & k_leaf_bit) != 0u);
}
#else
NodeBox box_of(uint entry) {
    uvec4 node = tree_texel(entry); // of the first octant, whose near sides are the lower ones
    return NodeBox(vec3(node.xyz & 0xffffu), vec3(node.xyz >> 16), (node.w & k_leaf_bit) != 0u);
}
#endif

// Where the ray enters a box (in x) and leaves it; the axis of the face that it enters.
vec2 cross_box(NodeBox box, vec3 origin, vec3 inverse, out int axis) {
    vec3 a = (box.low - origin) * inverse, b = (box.high - origin) * inverse, enter = min(a, b), leave = max(a, b);
    float first = max(enter.x, max(enter.y, enter.z));
    axis = first == enter.x ? 0 : (first == enter.y ? 1 : 2);
    return vec2(first, min(leave.x, min(leave.y, leave.z)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_nodes)))) return;
    vec3 ray = normalize(pixel_ray(vec2(pixel))), colour = vec3(0.02, 0.022, 0.026);
    float nearest = 3.0e38;
    uint roots = tree_texel(0u).x;
    for (uint i = 0u; i < roots; ++i) {
        uint root = k_header_texels + k_root_texels * i;
        uvec4 place = tree_texel(root);
        vec3 o = camera_position, d = ray;
        if ((place.w & 1u) == 0u) {
            vec4 x = uintBitsToFloat(tree_texel(root + 4u)), y = uintBitsToFloat(tree_texel(root + 5u)), z = uintBitsToFloat(tree_texel(root + 6u));
            o = vec3(dot(x, vec4(o, 1.0)), dot(y, vec4(o, 1.0)), dot(z, vec4(o, 1.0)));
            d = vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d));
        }
        vec3 scale = uintBitsToFloat(tree_texel(root + 3u).xyz);
        o = (o - uintBitsToFloat(tree_texel(root + 2u).xyz)) * scale;
        vec3 inverse = 1.0 / (without_zeros(d) * scale);
        int depth = 0;
#if wide_nodes
        for (uint slot = 0u; slot < 4u; ++slot) levels[depth] = 0, stack[depth++] = place.x << 2 | slot;
#else
        levels[depth] = 0, stack[depth++] = place.x;
#endif
        while (depth > 0) {
            uint entry = stack[--depth];
            int here = levels[depth], axis;
            NodeBox box = box_of(entry);
            vec2 t = cross_box(box, o, inverse, axis);
            if (any(lessThan(box.high, box.low)) || t.x > t.y || t.y <= 0.0 || t.x >= nearest) continue;
            if (box.leaf || here >= level) {
                if (t.x <= 0.0) continue;
                nearest = t.x;
                uint bits = hash_u32(entry);
                vec3 own = vec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / 255.0;
                colour = (0.25 + 0.75 * own) * (axis == 1 ? 1.0 : (axis == 0 ? 0.6 : 0.4));
                continue;
            }
#if wide_nodes
            uint child = tree_texel((entry >> 2) + 3u)[entry & 3u] & (k_leaf_bit - 1u);
            for (uint slot = 0u; slot < 4u && depth < k_stack; ++slot) levels[depth] = here + 1, stack[depth++] = child << 2 | slot;
#else
            uvec4 first = tree_texel(entry + 1u);
            uint second = (first.w & k_leaf_bit) != 0u ? entry + 2u : first.w;
            levels[depth] = here + 1, stack[depth++] = second;
            levels[depth] = here + 1, stack[depth++] = entry + 1u;
#endif
        }
    }
    imageStore(debug_nodes, pixel, vec4(colour, nearest < 3.0e38 ? nearest : 0.0));
}
