#ifndef LDM_SURFACE_RAY_GLSL
#define LDM_SURFACE_RAY_GLSL
// A map's ray that leaves a surface: along its axis or against it.
#include "ldm/trace.glsl"

struct LdmRay {
    vec3 direction;
    float cosine;   // to the shading normal n
    float distance; // metres to the next surface; k_no_hit: none
};

// False where the surface itself is in the way of that ray (n and the triangle's normal `face` do not agree).
bool ldm_surface_ray(int slot, LdmView view, vec3 x, vec3 n, vec3 face, out LdmRay ray) {
    float cosine = dot(n, view.direction), above = dot(face, view.direction);
    ray = LdmRay(cosine > 0.0 ? view.direction : -view.direction, abs(cosine), k_no_hit);
    if (cosine * above <= 0.0) return false;
    vec2 both = ldm_trace(slot, view, x, face).distance;
    ray.distance = cosine > 0.0 ? both.y : both.x;
    return true;
}
#endif
