#ifndef LDM_TILES_GLSL
#define LDM_TILES_GLSL
// Tiles of the picture that photons are splatted to.
uniform vec2 splat_size; // of that picture

const int k_tile = 8;

int tiles_across() {
    return (int(splat_size.x) + k_tile - 1) / k_tile;
}
int tile_count() {
    return tiles_across() * ((int(splat_size.y) + k_tile - 1) / k_tile);
}

// Two words a box: lowest and highest texel, 16 bits a coordinate.
bool box_meets(uvec2 box, uvec2 first, uvec2 last) {
    uvec2 low = uvec2(box.x & 0xffffu, box.x >> 16), high = uvec2(box.y & 0xffffu, box.y >> 16);
    return all(lessThanEqual(low, last)) && all(greaterThanEqual(high, first));
}
bool meets_tile(uvec2 box, int tile) {
    uvec2 first = uvec2(tile % tiles_across(), tile / tiles_across()) * uint(k_tile);
    return box_meets(box, first, first + uint(k_tile - 1));
}
#endif
