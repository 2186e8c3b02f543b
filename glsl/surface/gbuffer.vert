// Transforms the scene for the G-buffer.
#define SCENE_DRAWS
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "lib/vertex.glsl"

out Surface {
    vec3 position; // world
    vec3 normal;   // world, authored
    vec4 tangent;
    vec4 uv; // TEXCOORD_0, TEXCOORD_1
    vec4 colour;
    vec3 motion; // to where it was a frame ago, metres
} surface;
flat out uint surface_material;
flat out uint surface_draw;

void main() {
    Draw draw = draws[gl_BaseInstance];
    vec4 position = draw.world * vec4(vertex_position_u.xyz, 1.0);
    surface.position = position.xyz;
    surface.normal = world_normal(draw, vertex_normal_v.xyz);
    surface.tangent = world_tangent(draw, vertex_tangent);
    surface.motion = (draw.previous_world * vec4(vertex_position_u.xyz, 1.0)).xyz - position.xyz;
    surface.uv = vec4(vertex_position_u.w, vertex_normal_v.w, vertex_uv1);
    surface.colour = vertex_colour();
    surface_material = draw.material;
    surface_draw = gl_BaseInstance;
    gl_Position = view_projection * position;
}
