#include "app/ui/camera_control.h"

#include "scene/camera_ray.h"
#include "scene/default_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace bounce {

glm::vec3 point_under(const Session& session, glm::vec2 pixel) {
    Camera camera = session.camera();
    glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
    glm::vec2 size(session.size());
    glm::vec3 ray = camera_ray(basis, std::tan(0.5f * camera.vfov), size, pixel);
    float along = std::max(glm::dot(ray, basis[2]), 1e-3f);
    float distance = glm::distance(camera.position, camera.target);
    const GpuTexture* depth = session.graph().texture("gbuffer.depth");
    if (depth && *depth && depth->desc().kind == TextureKind::texture_2d) {
        glm::ivec2 texels(depth->desc().size);
        glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(pixel / size * glm::vec2(texels))), glm::ivec2(0), texels - 1);
        float value = 0;
        glGetTextureSubImage(depth->id(), 0, at.x, at.y, 0, 1, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof(value),
                             &value);
        // Reversed depth with an infinite far plane: near / distance, 0 where there is nothing.
        if (value > 0) distance = session.constants().near_plane / value;
    }
    return camera.position + ray * (distance / along);
}

Camera camera_of_whole_scene(const Session& session) {
    Camera camera = session.camera();
    glm::vec3 forward = glm::normalize(camera.target - camera.position);
    glm::vec2 size(session.size());
    Camera framed = framing_camera(session.facts().bounds_over_animation, forward, camera.vfov, size.x / size.y);
    framed.up = camera.up;
    framed.vfov = camera.vfov;
    framed.name = camera.name;
    return framed;
}

/// Turns about the up axis, then about the camera's right, both through `centre`; stops short of the poles.
static void rotate(Camera& camera, const glm::vec3& centre, float yaw, float pitch) {
    glm::vec3 up = glm::normalize(camera.up);
    glm::mat3 basis = camera_basis(camera.position, camera.target, up);
    float height = std::asin(std::clamp(glm::dot(basis[2], up), -1.0f, 1.0f));
    float limit = glm::radians(88.0f);
    pitch = std::clamp(height + pitch, std::min(-limit, height), std::max(limit, height)) - height;
    glm::quat turned = glm::angleAxis(yaw, up) * glm::angleAxis(pitch, basis[0]);
    camera.position = centre + turned * (camera.position - centre);
    camera.target = centre + turned * (camera.target - centre);
}

bool CameraControl::look(PanelContext& context, Camera& camera, const CameraInput& input) {
    bool moved = fly(context, camera, input);
    if (input.wheel != 0) {
        float& speed = context.ui.window.fly_speed;
        speed = std::clamp(speed * std::pow(1.25f, input.wheel), 0.001f, 1000.0f);
        char text[64];
        std::snprintf(text, sizeof(text), "flying speed ×%.3g", double(speed));
        context.ui.say(text);
    }
    if (input.moved == glm::vec2(0)) return moved;
    // The world follows the pointer by as much as it would lie under it in the picture's middle.
    float per_pixel = camera.vfov / float(context.session.size().y);
    rotate(camera, camera.position, -input.moved.x * per_pixel, -input.moved.y * per_pixel);
    return true;
}

bool CameraControl::fly(const PanelContext& context, Camera& camera, const CameraInput& input) {
    glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
    glm::vec3 way(0);
    way += basis[2] * float(input.forward - input.back);
    way += basis[0] * float(input.right - input.left);
    way += glm::normalize(camera.up) * float(input.up - input.down);
    if (glm::length(way) < 1e-3f) return false;
    float diagonal = context.session.facts().bounds_over_animation.diagonal();
    float speed = 0.1f * std::max(diagonal, 1e-3f) * context.ui.window.fly_speed * (input.fast ? 4.0f : 1.0f);
    // A slow machine's frame is no reason to jump through a wall.
    glm::vec3 step = glm::normalize(way) * speed * std::min(input.seconds, 0.25f);
    camera.position += step;
    camera.target += step;
    return true;
}

bool CameraControl::turn(Camera& camera, const CameraInput& input, glm::ivec2 size) {
    if (input.moved == glm::vec2(0)) return false;
    float per_pixel = glm::pi<float>() / float(size.y);
    rotate(camera, *pivot_, -input.moved.x * per_pixel, -input.moved.y * per_pixel);
    return true;
}

bool CameraControl::slide(Camera& camera, const CameraInput& input, glm::ivec2 size) {
    if (input.moved == glm::vec2(0)) return false;
    glm::mat3 basis = camera_basis(camera.position, camera.target, camera.up);
    float depth = std::max(glm::dot(*pivot_ - camera.position, basis[2]), 1e-4f);
    float per_pixel = 2 * depth * std::tan(0.5f * camera.vfov) / float(size.y);
    glm::vec3 step = per_pixel * (basis[1] * input.moved.y - basis[0] * input.moved.x);
    camera.position += step;
    camera.target += step;
    return true;
}

bool CameraControl::dolly(Camera& camera, const CameraInput& input, const glm::vec3& toward) {
    // Each notch covers a share of the way, so that near things are approached gently; never through the surface.
    glm::vec3 step = (toward - camera.position) * (1 - std::pow(0.87f, input.wheel));
    camera.position += step;
    camera.target += step;
    return true;
}

bool CameraControl::update(PanelContext& context, const CameraInput& input) {
    Session& session = context.session;
    Camera camera = session.camera();
    bool about = input.turn || input.slide;
    if (about && !pivot_) pivot_ = point_under(session, input.pixel);
    if (!about) pivot_.reset();

    bool moved = false;
    if (input.look)
        moved = look(context, camera, input);
    else if (input.turn)
        moved = turn(camera, input, session.size());
    else if (input.slide)
        moved = slide(camera, input, session.size());
    else if (input.hovered && input.wheel != 0)
        moved = dolly(camera, input, point_under(session, input.pixel));
    if (!moved) return false;
    session.set_camera(camera);
    context.ui.redraw();
    return true;
}

} // namespace bounce
