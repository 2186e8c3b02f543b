// One step of the directional volumes' mip chain: each direction from its own finer level (DVS, section VII). The volumes
// begin as zeros: empty voxels are not written.
#include "dvs/anisotropic.glsl"
#include "dvs/tiles.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D dvs_finer;  //! from dvs.directional
uniform usampler3D voxels_bricks;
layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional;

void main() {
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    int size = imageSize(dvs_directional).z;
    if (any(greaterThanEqual(voxel, ivec3(size)))) return;
    int bricks = textureSize(voxels_bricks, 0).x;
    bool held = size < bricks || texelFetch(voxels_bricks, voxel / max(size / bricks, 1), 0).r != 0u;
    for (int leaf = 0; leaf < (held ? 6 : 0); ++leaf) {
        ivec3 base = 2 * voxel + tile_of(leaf, 2 * size);
        vec4 children[8];
        float occupied = 0.0;
        for (int i = 0; i < 8; ++i) {
            children[i] = texelFetch(dvs_finer, base + ivec3(i & 1, (i >> 1) & 1, i >> 2), 0);
            occupied += children[i].a;
        }
        if (occupied > 0.0) imageStore(dvs_directional, voxel + tile_of(leaf, size), directional_mean(children, leaf));
    }
}
