// The parallelogram of a photon's footprint, as a strip of four vertices (LDM, section 4.2: vertex and geometry shader; an
// instance a photon needs no geometry shader).
#include "lib/frame.glsl"
#include "ldm/photon.glsl"

layout(std430) readonly buffer photons_stored { Photon stored[]; };

flat out int photon_index;

void main() {
    Photon photon = stored[gl_InstanceID];
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) - 0.5;
    photon_index = gl_InstanceID;
    gl_Position = view_projection * vec4(photon.position + corner.x * photon.du.xyz + corner.y * photon.dv.xyz, 1.0);
}
