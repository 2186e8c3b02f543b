// Marks the voxels that each triangle overlaps (DVS, section V.A), without a rasterizer and without looking at its surface: a
// program of its own, since software drivers run both sides of a branch.
#include "voxel/triangle_voxels.glsl"
#include "dvs/voxel_fragment.glsl"
#include "dvs/fragment_store.glsl"

layout(local_size_x = 256) in;

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {
    if (!taken_by_static(voxel)) store_mark(voxel, triangle.index);
}

void main() {
    visit_triangles();
}
