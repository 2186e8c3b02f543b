#ifndef VF_LISTS_GLSL
#define VF_LISTS_GLSL
// Visibility lists: for each texel of the low resolution the cells that its rays found, in ascending order. Each begins with
// its length and where its surface lies (bits of metres); an entry is a cell and how often it was seen and crossed
// (march.comp), 16 bits each.

const int k_list_header = 4;

int list_start(ivec2 texel, ivec2 size, int capacity) {
    return (texel.y * size.x + texel.x) * (k_list_header + 2 * capacity);
}
uint packed_counts(uint seen, uint crossed) {
    return min(seen, 0xffffu) << 16 | min(crossed, 0xffffu);
}
uvec2 unpacked_counts(uint counts) {
    return uvec2(counts >> 16, counts & 0xffffu);
}
#endif
