#ifndef VOXEL_WALK_TO_HIT_GLSL
#define VOXEL_WALK_TO_HIT_GLSL
// Where a ray from a surface is blocked, and how that is lit: voxels say that something is there, reflective shadow maps say
// exactly where, and what it sends back. Next to the surface, where voxels cannot tell what is near from the surface itself,
// the ray walks over the maps alone. What the voxels block, find_blocker says; whoever includes this file defines it.
#include "surface/map_walk.glsl"
#include "voxel/cone_steps.glsl"

uniform float map_near = 2.0;   //! [0, 64] (voxels) hit_lookup map: how far the walk from the surface goes
uniform float map_before = 1.5; //! [0, 8] (voxels) hit_lookup map: where the walk around a hit begins, before it
uniform float map_after = 1.5;  //! [0, 8] (voxels) hit_lookup map: where it ends, beyond the hit
uniform int map_tries = 4;      //! [1, 16] hit_lookup map: hits that are tried before the ray counts as unlit

// Where voxels block a ray: between two distances, in metres. enters < 0: nowhere.
struct Blocker {
    float enters;
    float leaves;
    ivec3 voxel; // the one that blocks, where the source tells it
};

// The first one from `from` metres on.
Blocker find_blocker(VoxelGrid grid, vec3 apex, vec3 direction, float from);

struct WalkedHit {
    float t;    // metres from the surface; below 0: nothing blocks
    bool met;   // by the maps; else by voxels alone, which no light reaches
    vec3 light; // that it sends back, of what the maps hold
    ivec3 voxel; // of the last blocker
};

// From `start` metres along the ray from the apex on; the maps from `walked` on: what lies before is known not to block.
WalkedHit walk_on(VoxelGrid grid, ConeStart start_point, vec3 direction, float start, float walked) {
    float same_place = 0.5 * grid.voxel, met;
    vec3 light;
    bool in_light;
    // A ray from an apex off the surface reaches a plane that faces the surface so much earlier than the ray from the
    // surface itself.
    float lag = normal_offset * grid.voxel / max(dot(start_point.face, direction), 0.25);
    Blocker blocker;
    for (int i = 0; i < map_tries; ++i) {
        blocker = find_blocker(grid, start_point.apex, direction, start);
        if (blocker.enters < 0.0) return WalkedHit(-1.0, false, vec3(0.0), ivec3(0));
        float from = max(blocker.enters - map_before * grid.voxel, walked);
        float to = max(blocker.leaves + map_after * grid.voxel + lag, walked);
        if (to <= walked) break;
        if (walk_maps(start_point.surface, start_point.face, direction, from, to, same_place, met, light, in_light))
            return WalkedHit(met, true, light, blocker.voxel);
        if (!in_light) break;
        start = walked = to;
    }
    return WalkedHit(blocker.enters, false, vec3(0.0), blocker.voxel);
}

// The maps are walked from the surface on, the voxels from the apex.
WalkedHit walk_to_hit(VoxelGrid grid, ConeStart start_point, vec3 direction) {
    float met, walked = map_near * grid.voxel;
    vec3 light;
    bool in_light = false;
    if (map_near > 0.0 &&
        walk_maps(start_point.surface, start_point.face, direction, 0.0, walked, 0.5 * grid.voxel, met, light, in_light))
        return WalkedHit(met, true, light, ivec3(0));
    float start = max(start_offset, 1.0e-3) * grid.voxel;
    return walk_on(grid, start_point, direction, in_light ? max(start, walked) : start, walked);
}

#endif
