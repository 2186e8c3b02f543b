// One slice of the occlusion voxels across an axis, at a mip: α. Right and up are z and y across x, x and −z across y
// (a map seen from above), x and y across z.
#include "voxel/leaf.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_voxel_slice) writeonly uniform image2D debug_voxel_slice;

uniform int axis = 1;      //! {x, y, z} that the slice lies across
uniform float at = 0.5;    //! [0, 1] where along the axis, as a share of the grid

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(debug_voxel_slice);
    if (any(greaterThanEqual(pixel, size))) return;
    int side = view_resolution();
    ivec2 place = pixel * side / size; // row 0 at the top
    int up = side - 1 - place.y, along = min(int(at * float(side)), side - 1);
    ivec3 voxel = axis == axis_x ? ivec3(along, up, place.x) : (axis == axis_y ? ivec3(place.x, along, place.y) : ivec3(place.x, up, along));
    imageStore(debug_voxel_slice, pixel, vec4(voxel_alpha(voxel)));
}
