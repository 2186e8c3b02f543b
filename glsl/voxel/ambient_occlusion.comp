// Ambient occlusion from cones over occlusion voxels (DVS, section VIII.B), 1 = open:
//   δ ← δ + (1 − δ)·α₂·f(r),  f(r) = 1/(1 + λ·r),  r the cone's radius.
// exact hits of thin cones (thin_cones) take f at the distance of the hit.
#include "voxel/cone.glsl"
#include "voxel/cone_set.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_out_ambient_occlusion) writeonly uniform image2D out_ambient_occlusion;  //! neutral 1

uniform int cone_set = 0;           //! {six, six_tilted, spiral, four} six as published
uniform int spiral_cones = 32;      //! [4, 256] cones of the set spiral
uniform int interleave = 1;         //! [1, 8] (texels) neighbours in blocks of n × n take different cones; 1: all take the same
uniform float aperture = 60.0;      //! [1, 90] (degrees) of each cone, from side to side
uniform float ambient_decay = 0.0;  //! [0, 10] (1/voxel) λ, how fast occlusion fades with the cone's radius; 0: it does not
uniform bool thin_cones = false;    //! cones end where they are blocked (find_hit) instead of gathering α

float cone_occlusion(VoxelGrid grid, vec3 apex, vec3 direction, float diameter) {
    float end = reach * scene_diagonal;
    if (thin_cones) {
        float hit = find_hit(grid, apex, direction, diameter, 0.5);
        return hit < 0.0 ? 0.0 : 1.0 / (1.0 + ambient_decay * 0.5 * diameter * hit / grid.voxel);
    }
    float t = max(start_offset, 1.0e-3) * grid.voxel, occlusion = 0.0, blocked = 0.0;
    for (int i = 0; i < max_steps && t < end && blocked < 0.99; ++i) {
        vec3 centre = apex + t * direction;
        if (outside_grid(grid, centre)) break;
        float d = max(diameter * t, grid.voxel);
        float alpha = sphere_occlusion(grid, centre, direction, sphere_level(grid, d));
        occlusion += (1.0 - occlusion) * alpha / (1.0 + ambient_decay * 0.5 * d / grid.voxel);
        blocked += (1.0 - blocked) * alpha;
        t += cone_step * d;
    }
    return occlusion;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    float depth = texelFetch(gbuffer_depth, pixel, 0).r, sum = 0.0;
    if (depth > 0.0) {
        VoxelGrid grid = cone_grid();
        vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
        vec3 face = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
        vec3 apex = world_position(pixel, depth) + normal_offset * grid.voxel * face;
        mat3 frame = frame_around(n);
        float diameter = 2.0 * tan(radians(0.5 * aperture)), part = interleaved_part(pixel, interleave);
        for (int i = 0; i < cone_count(cone_set, spiral_cones); ++i) {
            vec4 cone = cone_of(cone_set, spiral_cones, i, part);
            sum += cone.w * cone_occlusion(grid, apex, frame * cone.xyz, diameter);
        }
    }
    imageStore(out_ambient_occlusion, pixel, vec4(1.0 - sum));
}
