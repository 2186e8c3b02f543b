#pragma once
// How near the near plane of a view may lie that shall miss nothing.

namespace bounce {

/// Metres. Depth buffers are floats that hold near ÷ distance with an infinite far plane, so that their precision does
/// not depend on the near plane (Reed, "Depth precision visualized", 2015): it may be far smaller than the 6e-8 of a
/// scene that floats tell apart, and then nothing lies before it, whatever the scene's size. `diagonal` only keeps the
/// quotient within the range of floats; 0 counts as 1.
inline float smallest_near_plane(float diagonal) {
    return 1e-12f * (diagonal > 0 ? diagonal : 1.0f);
}

} // namespace bounce
