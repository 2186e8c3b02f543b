#pragma once
// The frame's constants: plain uniforms by name, all declared in glsl/lib/frame.glsl. They are no uniform block,
// because a compiled program tells which plain uniforms it really uses, and so what a pass depends on.

#include "core/revision.h"
#include "gpu/program.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace bounce {

/// Names are those of glsl/lib/frame.glsl.
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
};

/// One camera's part: matrices, basis, near plane. The plane is the camera's own, or else nearer than anything that
/// floats tell apart: depth = near ÷ distance is a float, as precise with the smallest plane as with a large one.
void set_camera(FrameConstants& constants, const Camera& camera, glm::ivec2 resolution, float scene_diagonal);

enum class FrameConstantType { real, integer, ivec2, vec3, mat4 };
struct FrameConstant {
    const char* name;
    FrameConstantType type;
    size_t offset, size; ///< bytes in FrameConstants
    Cause cause;         ///< of a change of its value
};
const std::vector<FrameConstant>& frame_constants();
/// Null when there is none of that name.
const FrameConstant* find_frame_constant(const std::string& name);
/// Whether a uniform of that OpenGL type can hold it (an ivec2 also goes into a vec2, an int into any scalar).
bool frame_constant_fits(const FrameConstant& constant, GLenum uniform_type);
void set_frame_constant(GLuint program, const UniformInfo& uniform, const FrameConstant& constant,
                        const FrameConstants& values);

} // namespace bounce
