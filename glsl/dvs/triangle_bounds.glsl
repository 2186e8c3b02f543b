#ifndef DVS_TRIANGLE_BOUNDS_GLSL
#define DVS_TRIANGLE_BOUNDS_GLSL
// Boxes around triangles, around each 64 of them in a row, and around each 64 of those: low and high corner in turn, one
// level behind the other. Neighbours in a mesh's order mostly are neighbours in space.
uniform int triangle_count;

int bounds_of_level(int level) { // how many
    return level == 0 ? triangle_count : (level == 1 ? (triangle_count + 63) / 64 : (triangle_count + 4095) / 4096);
}
int first_of_level(int level) {
    return level == 0 ? 0 : (level == 1 ? triangle_count : triangle_count + bounds_of_level(1));
}

#endif
