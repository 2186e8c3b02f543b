#pragma once
// std430 mirrors of glsl/ldm/photon.glsl.

#include <cstdint>
#include <glm/glm.hpp>

namespace bounce {

/// Where photons are split; `flux` times a photon's cosine is its Φ in W.
struct Emitter {
    glm::vec3 position;
    float pitch_texel; ///< metres; 0: there is none
    glm::vec3 normal;
    float padding_a;
    glm::vec3 flux;
    float padding_b;
    glm::vec4 incoming;
    glm::vec4 du_position, dv_position, du_direction, dv_direction;
};
static_assert(sizeof(Emitter) == 128);

/// A photon that the camera sees arrive.
struct Photon {
    glm::vec3 position;
    float area; ///< m²
    glm::vec3 flux;
    float padding_a;
    glm::vec4 du, dv;
};
static_assert(sizeof(Photon) == 64);

/// What became of a photon (photons.outcomes).
enum class PhotonFate : uint32_t { none, left, unseen, too_wide, arrived };

} // namespace bounce
