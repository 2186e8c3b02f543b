#pragma once
// Readers of the parts of a shot file. Each adds what is wrong to the reader's list.

#include "scene/json_object.h"
#include "scene/shot.h"

namespace bounce {

/// [{t, position, target}]: t in seconds, increasing; target in all keys or in none. Empty when absent or wrong.
Path read_path(JsonObject& object, const char* key);

/// {position, target, up, vfov_deg, near}, in the file's coordinates; the camera is in the loaded ones.
Camera read_camera(const nlohmann::json& value, const LoadedSpace& space, ErrorList& errors);

/// Adds one light of {name, type, position, direction | target, intensity, inner_cone_deg, outer_cone_deg, radius,
/// angular_radius_deg, enabled, path} and the node that carries it.
void read_light(const nlohmann::json& value, const std::string& where, ErrorList& errors, Scene& scene);

/// A radiance (a number or RGB), an .hdr file's name, or {map, scale, radiance}.
Environment read_environment(const nlohmann::json& value, const std::filesystem::path& base, ErrorList& errors);

/// The node of one of `objects`: {scene, name, position, rotation, scale, path}. `rotation` is 3 angles in degrees
/// (about X, then Y, then Z of the world) or a quaternion x, y, z, w; `scale` a number or 3. The scene's name goes to
/// `scene_name`.
Node read_object(const nlohmann::json& value, const std::string& where, ErrorList& errors, std::string& scene_name);

/// What a shot does not say: the camera (the file's first, or a default view), and for a plain glTF file without any
/// light a default one. Adds to the scene's notes.
void complete_shot(Shot& shot, bool has_camera, bool add_light);

} // namespace bounce
