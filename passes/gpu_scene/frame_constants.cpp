#include "gpu_scene/frame_constants.h"

#include "scene/camera_ray.h"
#include "scene/near_plane.h"

#include <cmath>

namespace bounce {

void set_camera(FrameConstants& c, const Camera& camera, glm::ivec2 resolution, float scene_diagonal) {
    glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
    c.camera_position = camera.position;
    c.camera_right = basis[0];
    c.camera_up = basis[1];
    c.camera_forward = basis[2];
    c.resolution = resolution;
    c.aspect = float(resolution.x) / float(resolution.y);
    c.tan_half_vfov = std::tan(0.5f * camera.vfov);
    c.near_plane = camera.near_plane > 0 ? camera.near_plane : smallest_near_plane(scene_diagonal);

    glm::mat3 rotation = glm::transpose(glm::mat3(basis[0], basis[1], -basis[2]));
    c.view = glm::mat4(rotation);
    c.view[3] = glm::vec4(rotation * -camera.position, 1);
    // Infinite far plane, reversed depth (near / distance), and y turned over so that row 0 is the top of the picture.
    float f = 1.0f / c.tan_half_vfov;
    c.projection = glm::mat4(0);
    c.projection[0][0] = f / c.aspect;
    c.projection[1][1] = -f;
    c.projection[2][3] = -1;
    c.projection[3][2] = c.near_plane;
    c.view_projection = c.projection * c.view;
    c.inverse_view_projection = glm::mat4(glm::inverse(glm::dmat4(c.view_projection)));
}

template <class T>
static constexpr FrameConstantType type_of() {
    if constexpr (std::is_same_v<T, float>)
        return FrameConstantType::real;
    else if constexpr (std::is_same_v<T, int>)
        return FrameConstantType::integer;
    else if constexpr (std::is_same_v<T, glm::ivec2>)
        return FrameConstantType::ivec2;
    else if constexpr (std::is_same_v<T, glm::vec3>)
        return FrameConstantType::vec3;
    else
        return FrameConstantType::mat4;
}

template <class T>
static FrameConstant constant(const char* name, T FrameConstants::*member, Cause cause = Cause::lasting) {
    return {name, type_of<T>(), offset_of(member), sizeof(T), cause};
}

const std::vector<FrameConstant>& frame_constants() {
    using C = FrameConstants;
    static const std::vector<FrameConstant> table = {
        constant("view", &C::view, Cause::camera),
        constant("projection", &C::projection, Cause::camera),
        constant("view_projection", &C::view_projection, Cause::camera),
        constant("inverse_view_projection", &C::inverse_view_projection, Cause::camera),
        constant("previous_view_projection", &C::previous_view_projection, Cause::passing),
        constant("camera_position", &C::camera_position, Cause::camera),
        constant("camera_right", &C::camera_right, Cause::camera),
        constant("camera_up", &C::camera_up, Cause::camera),
        constant("camera_forward", &C::camera_forward, Cause::camera),
        constant("tan_half_vfov", &C::tan_half_vfov, Cause::camera),
        constant("near_plane", &C::near_plane, Cause::camera),
        constant("aspect", &C::aspect),
        constant("resolution", &C::resolution),
        constant("time", &C::time, Cause::passing),
        constant("delta_time", &C::delta_time),
        constant("frame_index", &C::frame_index, Cause::passing),
        constant("scene_min", &C::scene_min),
        constant("scene_max", &C::scene_max),
        constant("scene_diagonal", &C::scene_diagonal),
        constant("environment_radiance", &C::environment_radiance),
        constant("environment_map", &C::environment_map),
        constant("light_count", &C::light_count),
        constant("diffuse_only", &C::diffuse_only),
        constant("normal_maps", &C::normal_maps),
        constant("material_model", &C::material_model),
        constant("shadow_view_count", &C::shadow_view_count),
        constant("pre_exposure", &C::pre_exposure),
    };
    return table;
}

const FrameConstant* find_frame_constant(const std::string& name) {
    for (const FrameConstant& known : frame_constants())
        if (known.name == name) return &known;
    return nullptr;
}

bool frame_constant_fits(const FrameConstant& constant, GLenum type) {
    switch (constant.type) {
    case FrameConstantType::real:
        return type == GL_FLOAT;
    case FrameConstantType::integer:
        return type == GL_INT || type == GL_UNSIGNED_INT || type == GL_BOOL || type == GL_FLOAT;
    case FrameConstantType::ivec2:
        return type == GL_INT_VEC2 || type == GL_FLOAT_VEC2;
    case FrameConstantType::vec3:
        return type == GL_FLOAT_VEC3;
    case FrameConstantType::mat4:
        return type == GL_FLOAT_MAT4;
    }
    return false;
}

void set_frame_constant(GLuint program, const UniformInfo& uniform, const FrameConstant& constant,
                        const FrameConstants& values) {
    if (!frame_constant_fits(constant, uniform.type)) return;
    const char* from = reinterpret_cast<const char*>(&values) + constant.offset;
    const auto* reals = reinterpret_cast<const float*>(from);
    const auto* integers = reinterpret_cast<const int*>(from);
    switch (constant.type) {
    case FrameConstantType::real:
        glProgramUniform1f(program, uniform.location, *reals);
        break;
    case FrameConstantType::integer:
        set_uniform(program, uniform, *integers);
        break;
    case FrameConstantType::ivec2:
        if (uniform.type == GL_INT_VEC2)
            glProgramUniform2iv(program, uniform.location, 1, integers);
        else
            glProgramUniform2f(program, uniform.location, float(integers[0]), float(integers[1]));
        break;
    case FrameConstantType::vec3:
        glProgramUniform3fv(program, uniform.location, 1, reals);
        break;
    case FrameConstantType::mat4:
        glProgramUniformMatrix4fv(program, uniform.location, 1, GL_FALSE, reals);
        break;
    }
}

} // namespace bounce
