// The first bounce between voxels: of direct light (dvs/bounce_voxels.glsl).
#include "dvs/bounce_voxels.glsl"

layout(local_size_x = 64) in;

void main() {
    bounce_voxel();
}
