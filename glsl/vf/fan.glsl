#ifndef VF_FAN_GLSL
#define VF_FAN_GLSL
// The rays of one texel of the low resolution. The march and the view of its rays share this, so that what is shown is what
// is done.
#include "surface/start.glsl"
#include "voxel/directions.glsl"
#include "vf/march.glsl"

uniform int rays = 16;              //! [1, 64] per texel of the low resolution
uniform float start_offset = 0.05;  //! [0, 4] (disc radii) off the surface, where rays start
uniform bool fixed_in_world = false; //! rays are turned by a hash of the surface's place in the world instead of the texel's
uniform float world_step = 0.01;    //! [1e-4, 0.2] fixed_in_world: places that share their rays, as a share of the diagonal

struct Fan {
    SamplePattern set;
    mat3 frame;
    vec3 origin, position, normal, face;
};

float unit_hash(uvec3 p) {
    uint x = p.x * 0x9e3779b1u ^ p.y * 0x85ebca6bu ^ p.z * 0xc2b2ae35u;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    return float(x >> 8) / 16777216.0;
}

bool fan_at(ivec2 texel, ivec2 size, out Fan fan) {
    StartPoint start;
    if (!start_at(pixel_of(texel, size), start)) return false;
    fan.set = pattern_at(texel);
    if (fixed_in_world) {
        uvec3 place = uvec3(ivec3(floor(start.position / (world_step * scene_diagonal))));
        fan.set.part = unit_hash(place);
        fan.set.turn = unit_hash(place + 0x1234567u);
    }
    fan.frame = frame_around(start.normal);
    fan.position = start.position;
    fan.normal = start.normal;
    fan.face = start.face;
    fan.origin = start.origin + start_offset * grid.disc_radius * start.face;
    return true;
}

// False: the ray would leave below the surface.
bool fan_direction(Fan fan, int i, out vec3 direction) {
    direction = fan.frame * direction_of(fan.set, i, rays);
    return dot(direction, fan.face) > 0.0;
}
#endif
