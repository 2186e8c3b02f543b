#pragma once
// What was found in the texture that the viewport shows: for legends and histograms.

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

struct Viewed {
    std::string resource;
    glm::vec2 range{0, 1};           ///< values that are drawn darkest and brightest
    std::vector<uint32_t> histogram; ///< how many values lie in each equal step from one to the other,
    uint32_t below = 0, above = 0;   ///< and outside; empty unless it was wanted
    bool wants_histogram = false;    ///< a panel draws it: set each frame
};

/// Of the last picture of the viewport.
Viewed& viewed();

/// The colour of a share from 0 to 1, as glsl/lib/heat_colour.glsl has it.
glm::vec3 heat_colour(float share);

} // namespace bounce
