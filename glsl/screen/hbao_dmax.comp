// Horizon-based ambient occlusion of what lies within d_max (see screen/horizon.glsl).
#include "screen/horizon.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform float d_max = 0.1;  //! [1e-4, 10] (scene diagonals) R: occluders further away do not count
uniform int falloff = 0;    //! {quadratic, none} W = 1 − (r/d_max)², as published, or 1 up to d_max

layout(FORMAT_out_ambient_occlusion_dmax) writeonly uniform image2D out_ambient_occlusion_dmax;  //! neutral 1

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    imageStore(out_ambient_occlusion_dmax, pixel, vec4(horizon_visibility(pixel, d_max * scene_diagonal, falloff == falloff_quadratic)));
}
