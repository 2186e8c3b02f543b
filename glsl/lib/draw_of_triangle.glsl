#ifndef LIB_DRAW_OF_TRIANGLE_GLSL
#define LIB_DRAW_OF_TRIANGLE_GLSL
// Which draw a triangle belongs to, when the triangles of all draws are numbered in a row. Define DRAW_START(i), the first
// triangle of draw i (and, for i = the number of draws, their sum), before including this file.

int draw_of(uint triangle, int draw_count) {
    int low = 0, high = draw_count; // DRAW_START(low) <= triangle < DRAW_START(high)
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (DRAW_START(middle) <= triangle) low = middle;
        else high = middle;
    }
    return low;
}
#endif
