// One photon in `every`: the parallelogram of its footprint. The draw behind them covers the picture.
#include "lib/frame.glsl"
#include "ldm/photon.glsl"

layout(std430) readonly buffer photons_stored { Photon stored[]; };

uniform int every = 64; //! [1, 65536] (photons) one footprint in so many is drawn
uniform bool background; // the draw that lies behind the footprints

flat out int photon_index;
out vec2 corner; // −1 … 1 over the parallelogram

void main() {
    photon_index = gl_InstanceID;
    corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    gl_Position = vec4(corner, 0.0, 1.0);
    if (background) return;
    Photon photon = stored[gl_InstanceID];
    gl_Position = view_projection * vec4(photon.position + 0.5 * (corner.x * photon.du.xyz + corner.y * photon.dv.xyz), 1.0);
    if (gl_InstanceID % every != 0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside
}
