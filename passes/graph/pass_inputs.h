#pragma once
// What a pass looked at on the CPU while it executed (PassContext records it). Together with what reflection tells of
// its programs, these are its inputs: as long as their values stand, it would look at the same again.

#include "gpu_scene/gpu_scene.h"

#include <cstddef>
#include <set>
#include <string>
#include <utility>

namespace bounce {

/// A stretch of bytes of a struct: offset, size.
using ByteRange = std::pair<size_t, size_t>;

struct PassInputs {
    std::set<ByteRange> frame;     ///< of FrameConstants
    std::set<ByteRange> facts;     ///< of SceneFacts
    std::set<ScenePart> scene;     ///< parts
    std::set<std::string> numbers; ///< names as expressions have them
};

} // namespace bounce
