// Injection as published (LPV, section 3.2): each texel of the reflective shadow maps is a point that is drawn into its cell's
// texel. Slices of a cascade lie side by side, cascades one above the other.
#include "lpv/light.glsl"
#include "lpv/start_cell.glsl"

flat out mat3x4 light;

void main() {
    ivec3 size = textureSize(rsm_depth, 0);
    int texels = size.x * size.y * size.z, cascade = gl_VertexID / texels, i = gl_VertexID % texels;
    ivec3 place = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    MapTexel texel = map_texel(place);
    light = mat3x4(0.0);
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // nowhere
    if (max(texel.intensity.r, max(texel.intensity.g, texel.intensity.b)) <= 0.0) return;
    float side = cascades[cascade].cell;
    ivec3 at = start_cell(cascades[cascade], texel, place.z);
    if (!in_grid(at, grid_size())) return;
    light = lobe_about(texel.normal, texel.intensity / (side * side));
    vec2 across = vec2(grid_cells * grid_cells, grid_cells * grid_cascades);
    gl_Position = vec4((vec2(at.z * grid_cells + at.x, cascade * grid_cells + at.y) + 0.5) / across * 2.0 - 1.0, 0.0, 1.0);
}
