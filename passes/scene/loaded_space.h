#pragma once
// Where a scene is loaded: relative to its centre when it lies far from the file's origin, in a unit of its own when it
// is very large or very small. Floats then keep what the file's own numbers tell.

#include "scene/scene.h"

#include <string>

namespace bounce {

/// Meshes whose vertices lie far from their own origin are moved to it, and very large or small ones brought to about a
/// metre; a node between brings them back. Vertices lose nothing: a difference of nearby floats is exact, or finer than
/// what the file holds, and the factor is a power of two.
void recentre_meshes(Scene& scene);

/// The space that suits the scene's geometry at time 0. It is told by where all but the outermost corners of triangles
/// lie (a 64th on each side), without those that stray (a third at most, if the rest is 256 times shorter than all), so
/// that a stray one does not decide.
LoadedSpace suitable_space(const Scene& scene);

/// Where a loaded place lies in the file; in the fewest digits that are loaded as it, where the space is the file's.
glm::dvec3 place_in_file(const LoadedSpace& space, const glm::vec3& loaded);

/// Loaded coordinates beyond this are refused: squares of them, and boxes around them, must be floats.
constexpr float k_farthest = 1e18f;

/// Throws Error when a node that draws, shines or looks lies where floats do not reach, or is not finite.
void check_placement(const Scene& scene, float time);
/// The same for one point (loaded); `what` names it in the message.
void check_place(const glm::vec3& loaded, const std::string& what);

} // namespace bounce
