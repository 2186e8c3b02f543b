// Occlusion voxels without a rasterizer: marks exactly the voxels that each triangle overlaps. No atomics.
#include "voxel/triangle_voxels.glsl"
#include "voxel/occlusion_store.glsl"

layout(local_size_x = 256) in;

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {
    store_occlusion(voxel, facing_of(triangle, corners_of(triangle)), (materials[triangle.material].flags & 1u) != 0u, resolution_of_grid);
}

void main() {
    visit_triangles();
}
