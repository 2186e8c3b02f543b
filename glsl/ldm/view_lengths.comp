// How many surfaces each texel of a map holds, as heat colours; a: the number itself.
#include "lib/heat_colour.glsl"
#include "ldm/viewed_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_ldm_lengths) writeonly uniform image2D debug_ldm_lengths;

uniform int max_length = 16; //! [1, 4096] surfaces that are shown white

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_viewed_now() || any(greaterThanEqual(pixel, imageSize(debug_ldm_lengths)))) return;
    int length = 0;
    ivec2 texel = ivec2(pixel.x, ldm.resolution - 1 - pixel.y); // the map's rows go up
    for (LdmCursor node = ldm_first(ldm_head(viewed_slot(), texel)); !ldm_ended(node); node = ldm_next(node))
        ++length;
    imageStore(debug_ldm_lengths, pixel, vec4(heat_colour(float(length) / float(max_length)), float(length)));
}
