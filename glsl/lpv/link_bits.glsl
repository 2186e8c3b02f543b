#ifndef LPV_LINK_BITS_GLSL
#define LPV_LINK_BITS_GLSL
// The 13 links in a cube of eight centres that no other such cube holds as well: its three lowest edges (bits 0–2, along x, y, z),
// two diagonals of each of its three lowest faces (3–8, across x, y, z), four diagonals of its own (9–12).

int link_bit(ivec3 step) {
    int axes = abs(step.x) + abs(step.y) + abs(step.z);
    if (axes == 1) return step.x != 0 ? 0 : (step.y != 0 ? 1 : 2);
    if (axes == 3) return 9 + (step.x * step.y > 0 ? 0 : 1) + (step.x * step.z > 0 ? 0 : 2);
    int across = step.x == 0 ? 0 : (step.y == 0 ? 1 : 2);
    return 3 + 2 * across + (step[(across + 1) % 3] * step[(across + 2) % 3] > 0 ? 0 : 1);
}

// Where link `bit` begins, from the cube's lowest corner, and which way it goes.
void link_of_bit(int bit, out ivec3 from, out ivec3 step) {
    from = step = ivec3(0);
    if (bit < 3) {
        step[bit] = 1;
    } else if (bit < 9) {
        int across = (bit - 3) >> 1, u = (across + 1) % 3, v = (across + 2) % 3;
        step[u] = step[v] = 1;
        if (((bit - 3) & 1) != 0) from[v] = 1, step[v] = -1;
    } else {
        step = ivec3(1, ((bit - 9) & 1) == 0 ? 1 : -1, ((bit - 9) & 2) == 0 ? 1 : -1);
        from = max(-step, ivec3(0));
    }
}
#endif
