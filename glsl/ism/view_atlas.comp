// The atlas of imperfect shadow maps: nearness as grey, holes red, what lies outside of the hemispheres dark blue.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform usampler2D ism_atlas;
layout(FORMAT_debug_ism_atlas) writeonly uniform image2D debug_ism_atlas;

uniform int map_side = 64;   //! [8, 512] (texels) width and height of a map
uniform float range = 0.7;   //! [0.01, 2] distance that is white, share of the diagonal

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(debug_ism_atlas)))) return;
    uint bits = texelFetch(ism_atlas, at, 0).r;
    vec2 p = (vec2(at % map_side) + 0.5) / float(map_side) * 2.0 - 1.0;
    vec3 colour = bits == 0u ? vec3(0.6, 0.03, 0.02) : vec3(1.0 / uintBitsToFloat(bits) / (range * scene_diagonal));
    if (dot(p, p) > 1.0) colour = vec3(0.0, 0.0, 0.05);
    imageStore(debug_ism_atlas, at, vec4(colour, 1.0));
}
