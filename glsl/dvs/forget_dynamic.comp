// After the dynamic voxels were cleared: the list ends where the static voxels end.
#include "dvs/list_build.glsl"

layout(local_size_x = 1) in;

void main() {
    listed = static_listed;
}
