// The volumes of DVS as cubes, from the camera (voxel/cube_march.glsl), one quantity at a time: albedo; normal as
// (N + 1)/2, so that it is grey where normals disagree; emission; the radiance that the front or the back sides send; what is
// sent along one of the six directions at a mip (radiance·α, drawn where α > threshold); flags, static blue and dynamic
// orange; collisions, the fragments that a voxel was made of, from blue (1) over green (16) to red (256 and more).
// a: distance to the cube's face in metres, 0 where there is none.
#include "voxel/cube_march.glsl"
#include "dvs/fixed_point.glsl"
#include "dvs/tiles.glsl"
#include "dvs/voxel_volumes.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler3D voxels_albedo;
uniform sampler3D voxels_emission;                  //! optional
uniform sampler3D dvs_base;                         // the radiance volume
uniform sampler3D dvs_directional;                  //! optional
uniform usampler3D voxels_place;
uniform usampler3D voxels_packed_albedo;            //! optional
layout(std430) readonly buffer voxels_sums { uint sums[]; }; //! optional
layout(FORMAT_debug_voxels) writeonly uniform image2D debug_voxels;

uniform int averaging = 0;        //! {average, last_writer, sum, gather} that made the voxels
uniform int quantity = 0;         //! {albedo, normal, emission, radiance, radiance_behind, x, minus_x, y, minus_y, z, minus_z, flags, collisions}
uniform int mip = 0;              //! [0, 9] of the six directions; clamped to those there are
uniform float threshold = 0.001;  //! [0, 1] the six directions: least α of a voxel that is drawn
uniform float exposure = 1.0;     //! [0.001, 1000] what emission and radiance are multiplied by

bool is_directional() {
    return quantity >= quantity_x && quantity <= quantity_minus_z;
}

int view_mip() {
    return is_directional() ? clamp(mip, 0, textureQueryLevels(dvs_directional) - 1) : 0;
}

vec4 directional(ivec3 voxel) {
    int level = view_mip();
    return texelFetch(dvs_directional, voxel + tile_of(quantity - 5, textureSize(dvs_directional, level).z), level);
}

bool cube_is_drawn(ivec3 voxel) {
    return is_directional() ? directional(voxel).a > threshold : texelFetch(voxels_flags, voxel, 0).r != 0u;
}

float fragments_of(ivec3 voxel) {
    if (averaging == averaging_last_writer) return 1.0; // it does not count
    if (averaging == averaging_average) return float(texelFetch(voxels_packed_albedo, voxel, 0).r >> 24);
    return float(sums[(texelFetch(voxels_place, voxel, 0).r - 1u) * k_sums]);
}

vec3 cube_colour(ivec3 voxel) {
    int behind = textureSize(dvs_base, 0).x;
    if (quantity == quantity_albedo) return texelFetch(voxels_albedo, voxel, 0).rgb;
    if (quantity == quantity_normal) return 0.5 * texelFetch(voxels_normal, voxel, 0).xyz + 0.5;
    if (quantity == quantity_emission) return exposure / pre_exposure * texelFetch(voxels_emission, voxel, 0).rgb;
    if (quantity == quantity_radiance) return exposure / pre_exposure * texelFetch(dvs_base, voxel, 0).rgb;
    if (quantity == quantity_radiance_behind)
        return textureSize(dvs_base, 0).z > behind ? exposure / pre_exposure * texelFetch(dvs_base, voxel + ivec3(0, 0, behind), 0).rgb : vec3(0.0);
    if (is_directional()) return exposure / pre_exposure * directional(voxel).rgb;
    if (quantity == quantity_flags) return (texelFetch(voxels_flags, voxel, 0).r & 2u) != 0u ? vec3(0.95, 0.5, 0.1) : vec3(0.25, 0.4, 0.8);
    return heat_colour(log2(max(fragments_of(voxel), 1.0)) / 8.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_voxels)))) return;
    int base_side = textureSize(voxels_flags, 0).x;
    CubeHit hit = march_cubes(pixel, is_directional() ? textureSize(dvs_directional, view_mip()).z : base_side, base_side);
    vec3 colour = hit.distance > 0.0 ? hit.light * cube_colour(hit.voxel) : k_cube_background;
    imageStore(debug_voxels, pixel, vec4(min(colour, vec3(65504.0)), hit.distance));
}
