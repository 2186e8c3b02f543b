#ifndef ISM_TEXEL_ORDER_GLSL
#define ISM_TEXEL_ORDER_GLSL
// The texels of layered maps one by one along Morton's curve, layer after layer: any stretch of the curve is compact, so that
// even steps along it are spread evenly over a map. (In rows, steps of one and a half rows would share two columns.)

// Side of the square, a power of two, that the curve fills.
uint order_side(ivec3 size) {
    uint longest = uint(max(size.x, size.y));
    return longest <= 1u ? 1u : 2u << findMSB(longest - 1u);
}
uint places_in_order(ivec3 size) {
    return order_side(size) * order_side(size) * uint(size.z);
}

// Every second bit of x; and back.
uint gathered_bits(uint x) {
    x &= 0x55555555u;
    x = (x | x >> 1) & 0x33333333u;
    x = (x | x >> 2) & 0x0f0f0f0fu;
    x = (x | x >> 4) & 0x00ff00ffu;
    return (x | x >> 8) & 0x0000ffffu;
}
uint scattered_bits(uint x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

uint place_in_order(ivec3 at, ivec3 size) {
    return uint(at.z) * order_side(size) * order_side(size) + (scattered_bits(uint(at.x)) | scattered_bits(uint(at.y)) << 1);
}
ivec3 texel_at_place(uint place, ivec3 size) {
    uint layer = order_side(size) * order_side(size), within = place % layer;
    return ivec3(gathered_bits(within), gathered_bits(within >> 1), place / layer);
}
#endif
