#ifndef DVS_TILES_GLSL
#define DVS_TILES_GLSL
// The six directional volumes lie in one 3D texture, two beside each other and three one above the other (six in a row
// would pass the limit of 2048 texels at 512³): leaf k of +x −x +y −y +z −z is tile (k mod 2, k / 2).
// Leaf k holds what surfaces that face axis k send and block: radiance·α and α.
ivec3 tile_of(int leaf, int size) {
    return ivec3(leaf & 1, leaf / 2, 0) * size;
}
#endif
