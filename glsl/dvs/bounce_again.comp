// Later bounces between voxels: of what the bounce before made (dvs/bounce_voxels.glsl).
#define DVS_PREVIOUS
#include "dvs/bounce_voxels.glsl"

layout(local_size_x = 64) in;

void main() {
    bounce_voxel();
}
