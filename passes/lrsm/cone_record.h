#pragma once
// What is kept of the final gather's cones at one pixel. glsl/lrsm/cone_record.glsl mirrors it.

#include <cstdint>
#include <glm/glm.hpp>

namespace bounce {

inline constexpr int k_max_recorded_cones = 128;
inline constexpr int k_max_recorded_spheres = 256; ///< a cone

/// All std430, 64 bytes each.
struct InspectedPixel {
    glm::ivec2 pixel;   ///< of the picture
    glm::ivec2 texel;   ///< of the gather's result
    glm::vec3 apex;     ///< metres
    int cones;          ///< 0: no surface
    glm::vec4 summed;   ///< Σ weight · radiance, and 1 − occlusion: as the gather has it
    glm::vec4 gathered; ///< what the gather stored
};

struct RecordedCone {
    glm::vec3 direction;
    float weight;
    glm::vec3 radiance; ///< W/(sr·m²)
    float occlusion;
    int first;      ///< of its spheres
    int kept;       ///< spheres that were recorded
    int spheres;    ///< that it has in all
    float end;      ///< metres: of its last sphere
    float diameter; ///< 2·tan(θ/2)
    float padding[3];
};

struct RecordedSphere {
    glm::vec3 centre;
    float t;        ///< metres from the apex
    float diameter; ///< metres
    float alpha;    ///< its occlusion
    float share;    ///< of the cone that it takes: (1 − occlusion before it)·α
    float voxel_level;
    glm::vec3 radiance; ///< that it adds to the cone
    float map_level;    ///< mip of the layers that it was looked up at, for the last light that has some; −1: none
    int layers;         ///< that light was taken from, of all lights
    int at_hit;         ///< 1: the lookup of hit_then_sample, 0: a sphere of the march
    int padding[2];
};

static_assert(sizeof(InspectedPixel) == 64 && sizeof(RecordedCone) == 64 && sizeof(RecordedSphere) == 64);

/// The buffer debug.cones begins so; RecordedCone::first counts spheres from its end.
struct ConeRecords {
    InspectedPixel inspected;
    RecordedCone cones[k_max_recorded_cones];
};

} // namespace bounce
