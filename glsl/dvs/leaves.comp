// Directional leaves: the directional volumes from the base level on. Leaf k of a voxel holds what the side of its surface
// that faces axis k sends; α is 1 where a surface faces that way (leaf_opacity binary), or its cosine to the axis. So a
// surface neither lights nor blocks what leaves it.
#include "dvs/list.glsl"
#include "dvs/tiles.glsl"
#include "dvs/voxel_surface.glsl"

layout(local_size_x = 64) in;

uniform sampler3D dvs_filtered; // radiance of both sides
layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional;

uniform int leaf_opacity = 0; //! {binary, cosine} what a leaf blocks: everything, or as much as its surface faces the axis

void main() {
    uint index = listed_index();
    if (index >= listed) return;
    ivec3 voxel = voxel_of(list[index]);
    int size = textureSize(voxels_normal, 0).x;
    vec3 n = voxel_normal(voxel);
    uint leaves = texelFetch(voxels_flags, voxel, 0).r >> 2;
    vec3 front = texelFetch(dvs_filtered, voxel, 0).rgb, back = front;
    if (textureSize(dvs_filtered, 0).z > size) back = texelFetch(dvs_filtered, voxel + ivec3(0, 0, size), 0).rgb;
    for (int leaf = 0; leaf < 6; ++leaf) {
        float cosine = dot(n, leaf_axis(leaf));
        float alpha = (leaves & (1u << leaf)) != 0u ? (leaf_opacity == leaf_opacity_binary ? 1.0 : min(abs(cosine) + 0.01, 1.0)) : 0.0;
        imageStore(dvs_directional, voxel + tile_of(leaf, size), vec4(alpha * (cosine > -0.01 ? front : back), alpha));
    }
}
