#pragma once
// What the cones panel keeps between frames.

#include "gpu/readback.h"
#include "lrsm/cone_record.h"

namespace bounce {

struct ConesState {
    Readback readback;
    uint64_t asked = ~0ull; ///< frame of the graph that was read back last
    ConeRecords records{};  ///< cones = 0 until the first has arrived
    std::vector<RecordedSphere> spheres;
    int chosen = 0;         ///< cone whose spheres are listed
    bool only_hits = false; ///< spheres without occlusion are left out

    /// Takes what has arrived and asks for the newest frame's records. True while more is on its way.
    bool follow(const Buffer& cones, uint64_t frame);
};

} // namespace bounce
