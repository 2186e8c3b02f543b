// Layers of a map side by side: tile k shows the k-th surface of each texel along the axis. Dark blue: the list ends before.
#include "ldm/viewed_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_ldm_layers) writeonly uniform image2D debug_ldm_layers;

uniform int quantity = 0; //! {depth, slope, albedo} slope needs ldm.nodes=plane, albedo ldm.nodes=surface
uniform int layer = 0;    //! [0, 1023] of the first tile
uniform int columns = 4;  //! [1, 16] of tiles
uniform int rows = 3;     //! [1, 16] of tiles

vec3 shown(LdmCursor node) {
    if (quantity == quantity_slope && ldm.node_words > 2) // a diagonal of the map is a depth of 1
        return vec3(0.5 + 0.5 * clamp(unpackHalf2x16(ldm_word(node, 2)) * float(ldm.resolution), vec2(-1.0), vec2(1.0)), 0.5);
    if (quantity == quantity_albedo && ldm.node_words > 3) return unpackUnorm4x8(ldm_word(node, 3)).rgb;
    return vec3(uintBitsToFloat(ldm_word(node, 0)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_viewed_now() || any(greaterThanEqual(pixel, imageSize(debug_ldm_layers)))) return;
    int cell = ldm.resolution + 2;
    ivec2 tile = pixel / cell, texel = pixel - tile * cell - 1;
    vec3 colour = vec3(0.15); // the border
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(ldm.resolution)))) {
        texel.y = ldm.resolution - 1 - texel.y; // the map's rows go up
        int wanted = layer + tile.y * columns + tile.x, k = 0;
        LdmCursor node = ldm_first(ldm_head(viewed_slot(), texel));
        for (; k < wanted && !ldm_ended(node); ++k)
            node = ldm_next(node);
        colour = vec3(0.0, 0.0, 0.12);
        if (!ldm_ended(node)) colour = shown(node);
    }
    imageStore(debug_ldm_layers, pixel, vec4(colour, 1.0));
}
