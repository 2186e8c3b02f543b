#ifndef LDM_TRACE_RECORD_GLSL
#define LDM_TRACE_RECORD_GLSL
// What is kept of the rays of one pixel. passes/ldm/trace_record.h mirrors it; every record has 32 bytes in std430.

struct TracedPixel {
    vec3 x;      // metres
    int rays;    // 0: no surface
    ivec2 pixel; // of the picture
    ivec2 padding;
};

struct RecordedRay { // of each map
    vec3 direction;
    float distance; // metres to what it meets; 1e30: nothing
    float cosine;   // to the normal; 0: the surface itself is in the way
    float padding_x, padding_y, padding_z;
};
#endif
