// The first level of the directional volumes from the radiance volume: all six directions of one voxel of half the
// resolution (DVS, section VII). The volumes begin as zeros: empty voxels are not written.
#include "dvs/anisotropic.glsl"
#include "dvs/tiles.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D dvs_filtered; // the radiance volume
layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional;

void main() {
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    int size = imageSize(dvs_directional).z;
    if (any(greaterThanEqual(voxel, ivec3(size)))) return;
    vec4 children[8];
    float occupied = 0.0;
    for (int i = 0; i < 8; ++i) {
        children[i] = texelFetch(dvs_filtered, 2 * voxel + ivec3(i & 1, (i >> 1) & 1, i >> 2), 0);
        occupied += children[i].a;
    }
    if (occupied <= 0.0) return;
    for (int leaf = 0; leaf < 6; ++leaf)
        imageStore(dvs_directional, voxel + tile_of(leaf, size), directional_mean(children, leaf));
}
