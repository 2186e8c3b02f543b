#pragma once
// What a scene holds, as numbers and in words.

#include "scene/shot.h"

#include <span>
#include <string>

namespace bounce {

/// Facts of a scene alone. Materials and textures are counted when something drawn uses them; `diffuse_only` counts no
/// material as glossy; `views` as in scene_extent.
SceneFacts scene_facts(const Scene& scene, bool diffuse_only = false, std::span<const Camera> views = {});

/// One line on what of the scene lies so far away that grids and fitted views leave it out; "" where nothing does.
std::string describe_strays(const SceneFacts& facts);

/// What `bounce info FILE` prints: what the shot holds, what was skipped, and so what it needs and does not need.
/// Lines end with '\n'.
std::string describe_scene(const Shot& shot);

} // namespace bounce
