#ifndef VF_TRIANGLES_GLSL
#define VF_TRIANGLES_GLSL
// The triangles of all draws in a row, in the world, and a number between 0 and 1 for each that stays with it when its
// object moves.
#define SCENE_DRAWS
#define SCENE_GEOMETRY
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "lib/coverage.glsl"

// The first triangle of each draw, in order; one more entry at the end.
layout(std430) readonly buffer vf_draw_starts { uint draw_starts[]; };
#define DRAW_START(i) draw_starts[i]
#include "lib/draw_of_triangle.glsl"

uniform int draw_count;

struct WorldTriangle {
    int draw;
    uint first; // of its indices
    vec3 positions[3]; // metres
    float area;        // m²
    uint hash;         // of its corners' positions in their object, and of the draw
};

WorldTriangle world_triangle(uint triangle) {
    WorldTriangle t;
    t.draw = draw_of(triangle, draw_count);
    t.first = draws[t.draw].first_index + 3u * (triangle - draw_starts[t.draw]);
    t.hash = hash_u32(uint(t.draw) + 1u);
    for (int i = 0; i < 3; ++i) {
        vec3 own = vertices[indices[t.first + uint(i)]].position_u.xyz;
        // In millionths of the scene: in another unit of length the same proxies are drawn.
        ivec3 place = ivec3(round(own / scene_diagonal * 1048576.0));
        for (int k = 0; k < 3; ++k)
            t.hash = hash_u32(t.hash ^ uint(place[k]));
        t.positions[i] = (draws[t.draw].world * vec4(own, 1.0)).xyz;
    }
    t.area = 0.5 * length(cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]));
    return t;
}

// How many proxies a triangle gets: area·density, whose fraction is drawn by the hash (Russian roulette).
uint proxies_of(WorldTriangle t, float density) {
    float wanted = t.area * density, whole = floor(wanted);
    return uint(whole) + (float(t.hash >> 8) / 16777216.0 < wanted - whole ? 1u : 0u);
}
#endif
