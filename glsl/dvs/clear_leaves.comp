// Clears the directional leaves of the dynamic voxels.
#include "dvs/list.glsl"
#include "dvs/tiles.glsl"

layout(local_size_x = 64) in;

layout(FORMAT_dvs_directional) writeonly uniform image3D dvs_directional;

void main() {
    uint index = listed_index();
    if (index < static_listed || index >= listed) return;
    for (int leaf = 0; leaf < 6; ++leaf)
        imageStore(dvs_directional, voxel_of(list[index]) + tile_of(leaf, imageSize(dvs_directional).z), vec4(0.0));
}
