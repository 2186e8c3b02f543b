#ifndef VF_TRIANGLES_GLSL
#define VF_TRIANGLES_GLSL
// The triangles of all draws in a row, in the world, and a number between 0 and 1 for each that stays with it when its
// object moves.
#define SCENE_DRAWS
#define SCENE_GEOMETRY
#include "lib/scene.glsl"

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

uint mixed(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

WorldTriangle world_triangle(uint triangle) {
    WorldTriangle t;
    t.draw = draw_of(triangle, draw_count);
    t.first = draws[t.draw].first_index + 3u * (triangle - draw_starts[t.draw]);
    t.hash = mixed(uint(t.draw) + 1u);
    for (int i = 0; i < 3; ++i) {
        vec3 own = vertices[indices[t.first + uint(i)]].position_u.xyz;
        for (int k = 0; k < 3; ++k)
            t.hash = mixed(t.hash ^ floatBitsToUint(own[k]));
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
