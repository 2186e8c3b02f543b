// Conservative rasterization along each triangle's dominant axis (DVS, section V.A): every edge is shifted outward by half a
// pixel (Hasselgren et al., "Conservative rasterization", 2005), so that a fragment comes from each column that the triangle
// touches; the fragment shader clips the excess by the triangle's bounding box.
#include "lib/triangle_box.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

layout(std430) readonly buffer voxels_draw_starts { uint draw_starts[]; };

uniform int resolution_of_grid;

in Corner {
    vec3 position;
    vec3 normal;
    vec4 uv;
    vec4 colour;
} corner[];
flat in uint corner_material[];
flat in uint corner_draw[];

out Surface {
    vec3 normal;
    vec4 uv;
    vec4 colour;
} surface;
flat out uint surface_material;
flat out uint surface_triangle;
flat out uint surface_draw;
flat out vec3 surface_a;
flat out vec3 surface_b;
flat out vec3 surface_c;

vec2 project(vec3 p, int axis) {
    return axis == 0 ? p.yz : (axis == 1 ? p.zx : p.xy);
}

void main() {
    vec3 a = corner[0].position, b = corner[1].position, c = corner[2].position;
    vec3 normal = cross(b - a, c - a);
    if (!is_within_floats(normal)) return;
    int axis = dominant_axis(normal);
    vec2 p[3] = vec2[3](project(a, axis), project(b, axis), project(c, axis));
    vec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
    float area = e1.x * e2.y - e1.y * e2.x;
    if (area == 0.0 || normal == vec3(0.0)) return;
    // Edge i from corner i to the next, as n·x = d with n outward, pushed out by the pixel's reach along n. Touching counts.
    vec3 lines[3];
    for (int i = 0; i < 3; ++i) {
        vec2 edge = p[(i + 1) % 3] - p[i];
        vec2 outward = normalize((area > 0.0 ? 1.0 : -1.0) * vec2(edge.y, -edge.x));
        lines[i] = vec3(outward, dot(outward, p[i]) + 0.501 * (abs(outward.x) + abs(outward.y)));
    }
    vec2 low = min(p[0], min(p[1], p[2])) - 0.51, high = max(p[0], max(p[1], p[2])) + 0.51;
    vec2 corners[3];
    for (int i = 0; i < 3; ++i) {
        vec3 before = lines[(i + 2) % 3], after = lines[i];
        float determinant = before.x * after.y - before.y * after.x;
        // Slivers have edges that hardly meet: far out along the corner is enough.
        if (abs(determinant) > 1.0e-4)
            corners[i] = vec2(before.z * after.y - before.y * after.z, before.x * after.z - before.z * after.x) / determinant;
        else
            corners[i] = p[i] + 4.0 * normalize(before.xy + after.xy + vec2(1.0e-12));
    }
    for (int i = 0; i < 3; ++i) {
        vec2 d = corners[i] - p[0];
        vec2 share = vec2(d.x * e2.y - d.y * e2.x, e1.x * d.y - e1.y * d.x) / area;
        surface.normal = corner[0].normal + share.x * (corner[1].normal - corner[0].normal) + share.y * (corner[2].normal - corner[0].normal);
        surface.uv = corner[0].uv + share.x * (corner[1].uv - corner[0].uv) + share.y * (corner[2].uv - corner[0].uv);
        surface.colour = corner[0].colour + share.x * (corner[1].colour - corner[0].colour) + share.y * (corner[2].colour - corner[0].colour);
        surface_material = corner_material[0];
        surface_draw = corner_draw[0];
        surface_triangle = draw_starts[corner_draw[0]] + uint(gl_PrimitiveIDIn);
        surface_a = a;
        surface_b = b;
        surface_c = c;
        gl_Position = vec4(corners[i] * (2.0 / float(resolution_of_grid)) - 1.0, 0.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
