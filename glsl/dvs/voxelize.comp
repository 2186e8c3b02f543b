// Voxelization into albedo, normal and emission without a rasterizer (DVS, section V.A): each triangle visits the voxels that
// it overlaps. operation: add or average (dvs/fragment_store.glsl); marks: dvs/mark.comp.
#include "voxel/triangle_voxels.glsl"
#include "dvs/triangle_fragment.glsl"
#include "dvs/fragment_store.glsl"

layout(local_size_x = 256) in;

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {
    if (taken_by_static(voxel)) return;
    store_fragment(voxel, fragment_of(triangle, voxel));
}

void main() {
    visit_triangles();
}
