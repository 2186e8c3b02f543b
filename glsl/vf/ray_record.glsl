#ifndef VF_RAY_RECORD_GLSL
#define VF_RAY_RECORD_GLSL
// What is kept of the rays of one texel of the low resolution. passes/vf/ray_record.h mirrors it.
const int k_max_recorded_rays = 64;

struct InspectedFan {
    ivec2 texel;  // of the low resolution; −1: no surface
    int rays;
    int padding;
    vec4 origin;  // metres
};

// xyz: direction; w: metres to the disc that it meets, below 0: none.
struct RecordedFan {
    InspectedFan fan;
    vec4 ray[k_max_recorded_rays];
};
#endif
