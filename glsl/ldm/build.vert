// Transforms the scene for the maps of a batch: instance = slot. All maps share one viewport; the slot tells them apart.
#define SCENE_DRAWS
#include "lib/scene.glsl"
#include "lib/vertex.glsl"
#include "ldm/views.glsl"

uniform int batch; // its number

out Surface {
    float depth;
    vec4 uv;
    vec4 colour;
} surface;
flat out uint surface_material;
flat out uint surface_draw;
flat out int surface_slot;

void main() {
    Draw draw = draws[gl_BaseInstance];
    LdmView view = views[batch + gl_InstanceID * ldm.batches];
    vec3 p = ldm_project(view, (draw.world * vec4(vertex_position_u.xyz, 1.0)).xyz);
    surface.depth = p.z;
    surface.uv = vec4(vertex_position_u.w, vertex_normal_v.w, vertex_uv1);
    surface.colour = vertex_colour();
    surface_material = draw.material;
    surface_draw = gl_BaseInstance;
    surface_slot = gl_InstanceID;
    gl_Position = vec4(2.0 * p.xy / float(ldm.resolution) - 1.0, p.z, 1.0);
}
