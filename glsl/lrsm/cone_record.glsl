#ifndef LRSM_CONE_RECORD_GLSL
#define LRSM_CONE_RECORD_GLSL
// What is kept of the cones of one pixel. passes/lrsm/cone_record.h mirrors it; every record has 64 bytes in std430.

const int k_max_recorded_cones = 128;
const int k_max_recorded_spheres = 256; // a cone

struct InspectedPixel {
    ivec2 pixel; // of the picture
    ivec2 texel; // of the gather's result
    vec3 apex;   // metres
    int cones;   // 0: no surface
    vec4 summed;   // Σ weight · radiance, and 1 − occlusion: as the gather has it
    vec4 gathered; // what the gather stored
};

struct RecordedCone {
    vec3 direction;
    float weight;
    vec3 radiance; // W/(sr·m²)
    float occlusion;
    int first;   // of its spheres
    int kept;    // spheres that were recorded
    int spheres; // that it has in all
    float end;   // metres: of its last sphere
    float diameter; // 2·tan(θ/2)
    float padding_x, padding_y, padding_z;
};

struct RecordedSphere {
    vec3 centre;
    float t;        // metres from the apex
    float diameter; // metres
    float alpha;    // its occlusion
    float share;    // of the cone that it takes: (1 − occlusion before it)·α
    float voxel_level;
    vec3 radiance;   // that it adds to the cone
    float map_level; // mip of the layers that it was looked up at, for the last light that has some; −1: none
    int layers;      // that light was taken from, of all lights
    int at_hit;      // 1: the lookup of hit_then_sample, 0: a sphere of the march
    int padding_x, padding_y;
};

#endif
