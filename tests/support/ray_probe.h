#pragma once
// Random rays through a scene's trees by the shaders' own traversal, and what they met.

#include "support/scene_runner.h"

#include <cstring>

namespace bounce {

/// std430 mirror of the struct in probe_shader().
struct ProbedRay {
    glm::vec3 origin;
    float t; ///< of the hit
    glm::vec3 direction;
    uint32_t draw; ///< ~0: nothing was hit
    uint32_t corner, any;
    glm::vec2 uv;
    bool hit() const { return draw != ~0u; }
};
static_assert(sizeof(ProbedRay) == 48);

/// `make_ray`: GLSL that sets `origin` and `direction` from `vec3 a, b` (each in [0, 1)³), and may use the frame's
/// constants, and the scene's buffers if it names them. Rays are the same for the same number of them.
inline std::string probe_shader(const std::string& make_ray) {
    const bool of_scene = make_ray.find("vertices") != std::string::npos;
    return std::string(of_scene ? "#include \"traced/scene.glsl\"\n" : "") + R"(#include "lib/frame.glsl"
#include "traced/trace.glsl"
layout(local_size_x = 64) in;
struct Probed { vec3 origin; float t; vec3 direction; uint draw; uint corner, any; vec2 uv; };
layout(std430) writeonly buffer probe_rays { Probed probed[]; };
uniform int count = 1000; //! [1, 4000000] rays
uniform bool seeded = false; //! blended surfaces are there by chance
float unit(uint ray, uint which) { return float(hash_combine(ray, which) >> 8) / 16777216.0; }
void main() {
    uint ray = gl_GlobalInvocationID.x;
    if (int(ray) >= count) return;
    vec3 a = vec3(unit(ray, 1u), unit(ray, 2u), unit(ray, 3u)), b = vec3(unit(ray, 4u), unit(ray, 5u), unit(ray, 6u));
    vec3 origin, direction;
    )" + make_ray +
           R"(
    uint seed = seeded ? hash_combine(ray, 7u) | 1u : 0u;
    TracedHit hit = trace_nearest(origin, direction, 3.0e38, seed);
    bool any = trace_any(origin, direction, 3.0e38, seed);
    probed[ray] = Probed(origin, hit.t, direction, hit.draw, hit.corner, any ? 1u : 0u, hit.uv);
}
)";
}

/// Through the scene's bounds, in all directions.
inline const char* const k_rays_through_bounds =
    "origin = mix(scene_min, scene_max, a); direction = normalize(b * 2.0 - 1.0 + vec3(1.0e-3, 0.0, 0.0));";

inline std::string probe_graph(int count, bool seeded = false) {
    return R"("resources": {"probe.rays": {"kind": "buffer", "count": )" + std::to_string(count) +
           R"(, "stride": 48, "clear": false}}, "passes": [{"type": "bvh"},
        {"id": "probe", "type": "compute", "shader": "user/probe.comp", "params_of": "bvh", "dispatch": [)" +
           std::to_string(count) + R"(], "params": {"count": )" + std::to_string(count) + R"(, "seeded": )" +
           (seeded ? "true" : "false") + "}}]";
}

} // namespace bounce
