#ifndef DVS_CONE_GLSL
#define DVS_CONE_GLSL
// Cones through the directional volumes (DVS, section VIII): the three that face the cone are summed; below the first of
// their levels the base volume is blended in linearly. Colour and occlusion are gathered front to back,
//   c ← c + (1 − α)·c₂,  α ← α + (1 − α)·α₂   (c₂ is premultiplied: the paper's αc + (1 − α)·α₂c₂ counts α twice),
// and the ambient occlusion δ ← δ + (1 − δ)·α₂·f(r), f(r) = 1/(1 + λ·r), r the cone's radius.
// hit_then_sample first finds where the cone is blocked, by a thinner cone, and takes the colour there: Σc/Σα over a sphere
// of `hit_radius` voxels at least. exact_hits makes that a ray from voxel to voxel, and takes the colour of the side of the
// voxel's surface that it hits, without any directional volume.
#include "dvs/voxel_blocks.glsl"
#include "dvs/tiles.glsl"

uniform sampler3D dvs_base;        // the radiance volume
#ifdef DVS_PREVIOUS // the radiance volume is that of the bounce before
uniform sampler3D dvs_previous;
#define DVS_BASE dvs_previous
#else
#define DVS_BASE dvs_base
#endif
uniform int direction_weights = 0;    //! {squared, absolute} weights of the three volumes: d_k², or abs(d_k) (right for directional leaves)
uniform float ambient_decay = 0.1;    //! [0, 10] (1/voxel) λ, how fast occlusion fades with the cone's radius
uniform bool hit_then_sample = false; //! static the colour is looked up once a cone, where it is blocked
uniform bool exact_hits = false;      //! static hit_then_sample: the hit is found from voxel to voxel instead of by a thin cone
uniform bool emitters_apart = false;  //! static exact hits: what is met of emission is left to a pass of its own (dvs/emitted.comp)
uniform float hit_aperture = 2.0;     //! [0, 90] (degrees) hit_then_sample: of the cone that finds the hit
uniform float hit_threshold = 0.5;    //! [0.05, 0.99] hit_then_sample: occlusion from which the cone counts as blocked
uniform float hit_radius = 1.0;       //! [0.25, 16] (voxels) hit_then_sample: radius of the sphere that is looked up

// Where no directional volume is read none need be there.
#if hit_then_sample
#if exact_hits
#define DVS_WITHOUT_DIRECTIONS
#endif
#endif
#ifdef DVS_HITS_TRIANGLES
#define DVS_WITHOUT_DIRECTIONS
#endif
#ifndef DVS_WITHOUT_DIRECTIONS
uniform sampler3D dvs_directional; // six tiles; from the base level on, or from half the resolution
#endif

#if emitters_apart
#ifdef DVS_HITS_TRIANGLES // of samplers there are few
layout(FORMAT_voxels_emission) readonly uniform image3D voxels_emission; //! optional
#define VOXEL_EMISSION(voxel) imageLoad(voxels_emission, voxel).rgb
#else
uniform sampler3D voxels_emission; //! optional
#define VOXEL_EMISSION(voxel) texelFetch(voxels_emission, voxel, 0).rgb
#endif
#endif

VoxelGrid cone_grid() {
    int size = textureSize(dvs_base, 0).x;
#ifdef DVS_WITHOUT_DIRECTIONS
    return voxel_grid(size, 1, 1, 0);
#else
    int tile = textureSize(dvs_directional, 0).z;
    bool leaves = tile == size;
    int levels = textureQueryLevels(dvs_directional);
    return voxel_grid(size, leaves ? 6 : 1, leaves ? levels : levels + 1, 4);
#endif
}

vec4 directional_value(VoxelGrid grid, vec3 at, vec3 direction, float level) {
#ifdef DVS_WITHOUT_DIRECTIONS
    return vec4(0.0);
#else
    int size = textureSize(dvs_directional, 0).z;
    // Inside its own tile: half a voxel of the coarser of the two mips away from the next one.
    float margin = min(0.5 * exp2(ceil(level)) / float(size), 0.5);
    vec3 inside = clamp(at, vec3(margin), vec3(1.0 - margin));
    vec3 weight = direction_weights == direction_weights_squared ? direction * direction : abs(direction);
    vec4 sum = vec4(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        int leaf = 2 * axis + (direction[axis] > 0.0 ? 1 : 0); // a surface that faces −axis blocks what goes along +axis
        vec3 tile = vec3(tile_of(leaf, 1));
        sum += weight[axis] * textureLod(dvs_directional, (inside + tile) / vec3(2.0, 3.0, 1.0), level);
    }
    return sum.a > 1.0 ? sum / sum.a : sum;
#endif
}

// The front sides of the radiance volume.
vec4 base_value(sampler3D base, vec3 at) {
    ivec3 size = textureSize(base, 0);
    if (size.z > size.x) at.z = 0.5 * min(at.z, 1.0 - 0.5 / float(size.x));
    return textureLod(base, at, 0.0);
}

// Whether the base volume is blended in at a level: below the first one of the directional volumes.
bool is_near(VoxelGrid grid, float level) {
    return grid.leaves == 1 && level < 1.0;
}

// Premultiplied colour and α of a sphere, without the exponent, that lies inside the grid; from the directional volumes.
vec4 far_value(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return directional_value(grid, (position - grid.origin) / grid.side, direction, grid.leaves == 6 ? level : max(level - 1.0, 0.0));
}

// The same where the base volume is blended in.
vec4 near_value(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return mix(base_value(DVS_BASE, (position - grid.origin) / grid.side), far_value(grid, position, direction, level), level);
}

// Of any sphere.
vec4 sphere_value(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    if (outside_grid(grid, position)) return vec4(0.0);
    return is_near(grid, level) ? near_value(grid, position, direction, level) : far_value(grid, position, direction, level);
}

float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level) {
    return corrected_opacity(min(sphere_value(grid, position, direction, level).a, 1.0));
}

// What a voxel's side sends on, by a radiance volume.
vec3 colour_of_side(sampler3D volume, ivec3 voxel, bool front) {
    ivec3 size = textureSize(volume, 0);
    return texelFetch(volume, voxel + ivec3(0, 0, !front && size.z > size.x ? size.x : 0), 0).rgb;
}

// What a ray brings that ends at a voxel's side.
vec3 colour_at_hit(ivec3 voxel, bool front) {
    vec3 colour = colour_of_side(DVS_BASE, voxel, front);
#if emitters_apart
#ifdef HAS_voxels_emission
    colour = max(colour - VOXEL_EMISSION(voxel), vec3(0.0)); // both sides emit
#endif
#endif
    return colour;
}

struct Traced {
    vec3 colour;
    float occlusion;         // α
    float ambient_occlusion; // δ
    float away;              // metres to the hit of hit_then_sample; below 0: there is none
};

// Front to back.
void add_sphere(inout Traced cone, VoxelGrid grid, vec4 value, float d) {
    if (value.a <= 1.0e-4) return;
    float alpha = corrected_opacity(min(value.a, 1.0));
    cone.colour += (1.0 - cone.occlusion) * value.rgb * (alpha / value.a);
    cone.occlusion += (1.0 - cone.occlusion) * alpha;
    cone.ambient_occlusion += (1.0 - cone.ambient_occlusion) * alpha / (1.0 + ambient_decay * 0.5 * d / grid.voxel);
}

// `start_share`: how much of its first step the cone leaves out.
Traced trace_cone(VoxelGrid grid, vec3 apex, vec3 direction, float diameter, float start_share) {
    Traced cone = Traced(vec3(0.0), 0.0, 0.0, -1.0);
    if (hit_then_sample && exact_hits) {
        VoxelHit hit = find_blocking_voxel(grid, apex + start_offset * grid.voxel * direction, direction, 0.0);
        if (hit.t < 0.0) return cone;
        cone.colour = colour_at_hit(hit.voxel, hit.walk.front);
        cone.occlusion = 1.0;
        cone.ambient_occlusion = 1.0 / (1.0 + ambient_decay * 0.5 * diameter * hit.t / grid.voxel);
        cone.away = hit.t;
        return cone;
    }
    if (hit_then_sample) {
        float hit = find_hit(grid, apex, direction, 2.0 * tan(radians(0.5 * hit_aperture)), hit_threshold);
        if (hit < 0.0) return cone;
        float d = max(2.0 * hit_radius * grid.voxel, diameter * hit);
        vec4 there = sphere_value(grid, apex + hit * direction, direction, sphere_level(grid, d));
        cone.colour = there.a > 1.0e-4 ? there.rgb / there.a : vec3(0.0);
        cone.occlusion = 1.0;
        cone.ambient_occlusion = 1.0 / (1.0 + ambient_decay * 0.5 * diameter * hit / grid.voxel);
        cone.away = hit;
        return cone;
    }
    float t = max(start_offset, 1.0e-3) * grid.voxel, end = reach * scene_diagonal;
    t += start_share * cone_step * max(diameter * t, grid.voxel);
    // First the few steps that look up the base volume, too: where lanes share their way, a loop of its own is what keeps the
    // others from paying for them.
    int i = 0;
    for (; i < max_steps && t < end && cone.occlusion < 0.99; ++i) {
        vec3 centre = apex + t * direction;
        float d = max(diameter * t, grid.voxel), level = sphere_level(grid, d);
        if (!is_near(grid, level)) break;
        if (outside_grid(grid, centre)) return cone;
        add_sphere(cone, grid, near_value(grid, centre, direction, level), d);
        t += cone_step * d;
    }
    for (; i < max_steps && t < end && cone.occlusion < 0.99; ++i) {
        vec3 centre = apex + t * direction;
        if (outside_grid(grid, centre)) break;
        float d = max(diameter * t, grid.voxel);
        add_sphere(cone, grid, far_value(grid, centre, direction, sphere_level(grid, d)), d);
        t += cone_step * d;
    }
    return cone;
}

ConeLight light_along_cone(VoxelGrid grid, ConeStart start, vec3 direction, float diameter) {
    Traced cone = trace_cone(grid, start.apex, direction, diameter, 0.0);
    return ConeLight(cone.colour, cone.occlusion, cone.away);
}

#endif
