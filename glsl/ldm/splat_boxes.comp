// The box of pixels that a photon's footprint covers, and the box around each 256 photons in a row. Two words a box: lowest
// and highest pixel, 16 bits a coordinate.
#include "lib/frame.glsl"
#include "ldm/photon.glsl"
#include "ldm/tiles.glsl"

layout(local_size_x = 256) in;

layout(std430) readonly buffer photons_stored { Photon stored[]; };
layout(std430) readonly buffer photons_commands { uint commands[]; };
layout(std430) writeonly buffer photons_boxes { uvec2 boxes[]; };
layout(std430) writeonly buffer photons_chunks { uvec2 chunks[]; };

shared uint low_x, low_y, high_x, high_y;

void main() {
    if (gl_LocalInvocationID.x == 0u) low_x = low_y = 0xffffu, high_x = high_y = 0u;
    barrier();
    uint i = gl_GlobalInvocationID.x;
    uvec2 low = uvec2(0xffffu), high = uvec2(0u); // empty
    if (i < commands[7]) {
        Photon photon = stored[i];
        vec2 least = vec2(1.0e9), most = vec2(-1.0e9);
        for (int corner = 0; corner < 4; ++corner) {
            vec2 at = vec2(corner & 1, corner >> 1) - 0.5;
            vec3 p = project_to_pixel(photon.position + at.x * photon.du.xyz + at.y * photon.dv.xyz);
            if (p.z <= near_plane) least = vec2(-1.0e9), most = vec2(1.0e9); // part of it is behind the camera
            p.xy *= splat_size / vec2(resolution);
            least = min(least, p.xy), most = max(most, p.xy);
        }
        ivec2 from = max(ivec2(floor(max(least, vec2(-1.0)))), ivec2(0));
        ivec2 to = min(ivec2(floor(min(most, splat_size))), ivec2(splat_size) - 1);
        if (all(lessThanEqual(from, to))) low = uvec2(from), high = uvec2(to);
        boxes[i] = uvec2(low.x | low.y << 16, high.x | high.y << 16);
    }
    atomicMin(low_x, low.x), atomicMin(low_y, low.y), atomicMax(high_x, high.x), atomicMax(high_y, high.y);
    barrier();
    if (gl_LocalInvocationID.x == 0u) chunks[gl_WorkGroupID.x] = uvec2(low_x | low_y << 16, high_x | high_y << 16);
}
