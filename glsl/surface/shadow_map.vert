// Transforms the scene for one shadow view.
#define SCENE_DRAWS
#include "lib/scene.glsl"
#include "lib/shadow.glsl"
#include "lib/vertex.glsl"

layout(std430) readonly buffer shadow_views { ShadowView views[]; };
uniform int view_index; // which of shadow_views

out Surface {
    vec4 uv;
    vec4 colour;
} surface;
flat out uint surface_material;
flat out uint surface_draw;

void main() {
    Draw draw = draws[gl_BaseInstance];
    surface.uv = vec4(vertex_position_u.w, vertex_normal_v.w, vertex_uv1);
    surface.colour = vertex_colour();
    surface_material = draw.material;
    surface_draw = gl_BaseInstance;
    gl_Position = views[view_index].view_projection * (draw.world * vec4(vertex_position_u.xyz, 1.0));
}
