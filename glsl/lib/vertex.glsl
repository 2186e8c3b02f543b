#ifndef LIB_VERTEX_GLSL
#define LIB_VERTEX_GLSL
// The attributes of a scene vertex, for vertex shaders that draw the scene. gl_BaseInstance is the index of the draw.
layout(location = 0) in vec4 vertex_position_u;
layout(location = 1) in vec4 vertex_normal_v;
layout(location = 2) in vec4 vertex_tangent;
layout(location = 3) in vec2 vertex_uv1;
layout(location = 4) in uvec2 vertex_colour_bits;

vec4 vertex_colour() {
    return vec4(unpackUnorm2x16(vertex_colour_bits.x), unpackUnorm2x16(vertex_colour_bits.y));
}
#endif
