#ifndef LDM_NODE_GLSL
#define LDM_NODE_GLSL
// A fragment as the words of a node: depth, slope, diffuse albedo.

uvec3 pack_node(float depth, vec2 slope, vec3 albedo) {
    // Slopes may be steeper than a half float reaches (edge-on triangles): they are cut off at a depth of 4 a texel.
    return uvec3(floatBitsToUint(clamp(depth, 0.0, 1.0)), packHalf2x16(clamp(slope, vec2(-4.0), vec2(4.0))),
                 packUnorm4x8(vec4(albedo, 1.0)));
}
#endif
