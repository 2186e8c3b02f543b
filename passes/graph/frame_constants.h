#pragma once
// The frame's constants, as the uniform block `Frame` of glsl/lib/frame.glsl (std140) and as plain uniforms by name.

#include "core/parameters.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace bounce {

/// Members in std140 order; names are those of glsl/lib/frame.glsl.
struct FrameConstants {
    glm::mat4 view{1};       ///< world → camera
    glm::mat4 projection{1}; ///< reversed depth: 1 at the near plane, 0 at infinity; row 0 at the top
    glm::mat4 view_projection{1};
    glm::mat4 inverse_view_projection{1};
    glm::mat4 previous_view_projection{1};
    glm::vec3 camera_position{0};
    float time = 0; ///< seconds
    glm::vec3 camera_right{1, 0, 0};
    float tan_half_vfov = 1;
    glm::vec3 camera_up{0, 1, 0};
    float near_plane = 0.01f; ///< metres; only the scale of depths, unless the camera has a plane of its own
    glm::vec3 camera_forward{0, 0, -1};
    float aspect = 1;       ///< width / height
    glm::vec3 scene_min{0}; ///< bounds over the animation
    float scene_diagonal = 1;
    glm::vec3 scene_max{0};
    float delta_time = 0;
    glm::vec3 environment_radiance{0};
    int environment_map = 0; ///< 1: multiply by the map
    glm::ivec2 resolution{1};
    int frame_index = 0;
    int light_count = 0;
    int diffuse_only = 0; ///< every material is Lambert with ρ = base colour · (1 − metallic)
    int shadow_view_count = 0;
    int normal_maps = 1;
    int material_model = 0; ///< MaterialModel; glsl/lib/material_model.glsl
    /// What lights, emission and environment are multiplied by on the GPU, and so all radiance there: a power of two.
    float pre_exposure = 1;
    float padding[3] = {};
};
static_assert(sizeof(FrameConstants) == 5 * 64 + 7 * 16 + 3 * 16);

/// One camera's part: matrices, basis, near plane. The plane is the camera's own, or else nearer than anything that
/// floats tell apart: depth = near ÷ distance is a float, as precise with the smallest plane as with a large one.
void set_camera(FrameConstants& constants, const Camera& camera, glm::ivec2 resolution, float scene_diagonal);

/// A constant by its name, as a plain uniform may ask for it (matrices come through the block only).
std::optional<ParameterValue> frame_constant(const FrameConstants& constants, const std::string& name);
std::vector<std::string> frame_constant_names();

} // namespace bounce
