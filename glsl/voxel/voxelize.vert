// Transforms the scene into voxel units, for every voxelization by the rasterizer.
#define SCENE_DRAWS
#include "lib/scene.glsl"
#include "lib/vertex.glsl"
#include "lib/voxel_grid.glsl"

uniform int resolution_of_grid;

out Corner {
    vec3 position; // voxel units
    vec3 normal;   // world, authored
    vec4 uv;
    vec4 colour;
} corner;
flat out uint corner_material;
flat out uint corner_draw;

void main() {
    Draw draw = draws[gl_BaseInstance];
    corner.position = world_to_voxel((draw.world * vec4(vertex_position_u.xyz, 1.0)).xyz, resolution_of_grid);
    corner.normal = mat3(draw.normal_matrix) * vertex_normal_v.xyz;
    corner.uv = vec4(vertex_position_u.w, vertex_normal_v.w, vertex_uv1);
    corner.colour = vertex_colour();
    corner_material = draw.material;
    corner_draw = gl_BaseInstance;
    gl_Position = vec4(0.0);
}
