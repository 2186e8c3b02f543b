// Occlusion voxels without a rasterizer, one byte a voxel.
#include "voxel/occlusion_store.glsl"
#include "voxel/occlusion_by_triangle.glsl"

void main() {
    mark_voxels_of_triangle();
}
