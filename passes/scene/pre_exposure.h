#pragma once
// Half floats reach from 6e-8 to 65504. Scenes in millimetres with lamps to match, or of the sun, do not fit; so all
// light is multiplied by one power of two before it is stored, and divided by it where it is shown or written.

#include "scene/scene.h"

namespace bounce {

/// The power of two for a scene: 1 for ordinary scenes; else such that the brightest radiance that is likely (a white
/// surface next to a lamp; 64 times what a sun lights, an emitter sends or the environment is) lies about 2^10. That
/// leaves a factor of 64 above it, and of 2^24 below it before half floats lose bits. It depends on
/// intensities and sizes alone and not on where lights are, so that nothing that moves changes it. A power of two,
/// because it changes no bits of what neither overflows nor underflows.
float pre_exposure(const SceneState& state, const std::vector<Material>& materials, const Environment& environment,
                   float scene_diagonal);

} // namespace bounce
