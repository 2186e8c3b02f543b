// The first level of the directional volumes from the radiance volume: all six directions of one voxel of half the
// resolution (DVS, section VII). An invocation makes the eight of a brick, if it holds anything; the volumes begin as zeros,
// and empty voxels are not written.
#include "dvs/anisotropic.glsl"
#include "dvs/tiles.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D dvs_filtered; // the radiance volume
uniform usampler3D voxels_bricks;
layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional;

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    int size = imageSize(dvs_directional).z;
    if (any(greaterThanEqual(2 * brick, ivec3(size)))) return;
    int voxels = texelFetch(voxels_bricks, brick, 0).r != 0u ? 8 : 0;
    for (int k = 0; k < voxels; ++k) {
        ivec3 voxel = 2 * brick + ivec3(k & 1, (k >> 1) & 1, k >> 2);
        vec4 children[8];
        float occupied = 0.0;
        for (int i = 0; i < 8; ++i) {
            children[i] = texelFetch(dvs_filtered, 2 * voxel + ivec3(i & 1, (i >> 1) & 1, i >> 2), 0);
            children[i].a = min(children[i].a, 1.0); // what lies above is no occupancy (dvs/emitters.comp)
            occupied += children[i].a;
        }
        if (occupied <= 0.0) continue;
        for (int leaf = 0; leaf < 6; ++leaf)
            imageStore(dvs_directional, voxel + tile_of(leaf, size), directional_mean(children, leaf));
    }
}
