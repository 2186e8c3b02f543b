// Projects each triangle along its dominant axis, so that it covers as many voxel columns as possible (Crassin & Green,
// "Octree-based sparse voxelization using the GPU hardware rasterizer", 2012). With fill = exact it emits the rectangle
// around the projection, and the fragment shader decides.
#include "lib/triangle_box.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

uniform int resolution_of_grid;
uniform int fill = 0;  //! {centre, exact} one voxel per column (published), or every voxel that is overlapped

in Corner {
    vec3 position;
    vec3 normal;
    vec4 uv;
    vec4 colour;
} corner[];
flat in uint corner_material[];
flat in uint corner_draw[];

out Surface {
    vec4 uv;
    vec4 colour;
} surface;
flat out uint surface_material;
flat out uint surface_draw;
flat out vec3 surface_a;
flat out vec3 surface_b;
flat out vec3 surface_c;
flat out vec3 surface_facing;

// The projected plane's coordinates of axis x, y, z.
vec2 project(vec3 p, int axis) {
    return axis == 0 ? p.yz : (axis == 1 ? p.zx : p.xy);
}

void emit(vec2 plane, vec4 uv, vec4 colour, vec3 facing) {
    surface.uv = uv;
    surface.colour = colour;
    surface_material = corner_material[0];
    surface_draw = corner_draw[0];
    surface_a = corner[0].position;
    surface_b = corner[1].position;
    surface_c = corner[2].position;
    surface_facing = facing;
    gl_Position = vec4(plane * (2.0 / float(resolution_of_grid)) - 1.0, 0.0, 1.0);
    EmitVertex();
}

void main() {
    vec3 a = corner[0].position, b = corner[1].position, c = corner[2].position;
    vec3 normal = cross(b - a, c - a);
    if (!is_within_floats(normal)) return;
    float size = length(normal);
    vec3 facing = size > 0.0 ? normal / size : vec3(0.0);
    if (dot(facing, corner[0].normal + corner[1].normal + corner[2].normal) < 0.0) facing = -facing;
    int axis = dominant_axis(normal);
    vec2 p[3] = vec2[3](project(a, axis), project(b, axis), project(c, axis));
    if (fill == fill_centre) {
        for (int i = 0; i < 3; ++i)
            emit(p[i], corner[i].uv, corner[i].colour, facing);
        EndPrimitive();
        return;
    }
    // A pixel's centre lies in the rectangle whenever the triangle touches the pixel.
    vec2 low = floor(min(p[0], min(p[1], p[2]))), high = floor(max(p[0], max(p[1], p[2]))) + 1.0;
    // Touching counts: a triangle that ends exactly at a voxel's border overlaps the one before, too.
    low -= 0.75;
    high += 0.75;
    // Attributes are affine in the plane: carried on from the corners.
    vec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
    float area = e1.x * e2.y - e1.y * e2.x;
    for (int i = 0; i < 4; ++i) {
        vec2 at = vec2((i & 1) == 0 ? low.x : high.x, (i & 2) == 0 ? low.y : high.y);
        vec2 d = at - p[0];
        vec2 share = area != 0.0 ? vec2(d.x * e2.y - d.y * e2.x, e1.x * d.y - e1.y * d.x) / area : vec2(0.0);
        emit(at, corner[0].uv + share.x * (corner[1].uv - corner[0].uv) + share.y * (corner[2].uv - corner[0].uv),
             corner[0].colour + share.x * (corner[1].colour - corner[0].colour) + share.y * (corner[2].colour - corner[0].colour), facing);
    }
    EndPrimitive();
}
