#pragma once
// The directions of layered depth maps (LDM, section 3.2): centres of the recursive zonal equal-area partition of the
// sphere (Leopardi 2006), of which one of each antipodal pair is kept.

#include <glm/glm.hpp>
#include <vector>

namespace bounce {

/// A region of the partition: low ≤ colatitude ≤ high (from +z), and longitudes from … to (both may exceed 2π).
struct ZonalRegion {
    double colatitude_low = 0, colatitude_high = 0;
    double longitude_low = 0, longitude_high = 0; ///< 0 … 2π for the caps
    glm::dvec3 centre{0, 0, 1};
};

/// EQ(n): n ≥ 1 regions of equal area (4π/n) and small diameter, from the north cap to the south cap.
std::vector<ZonalRegion> zonal_equal_area_partition(int regions);

/// Unit axes of `maps` layered depth maps: the centres of EQ(2·maps) above the equator, and one half of the ring on it.
/// Each serves both of its directions. `maps` ≥ 1.
std::vector<glm::vec3> ldm_directions(int maps);

/// A fixed turn off the world's axes, so that no map looks along walls that follow them.
glm::mat3 tilt_off_axes();
/// The turn of frame `index` when directions change from frame to frame: low-discrepancy over all rotations; frame 0
/// has none.
glm::mat3 turn_of_frame(int index);

} // namespace bounce
