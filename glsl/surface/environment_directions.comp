// The irradiance that the environment brings from around each of the directions of reflective shadow maps of it, on a surface
// that faces the direction: E_i = Σ_j L(ω_j)·4π/N over those of N directions that are nearest to it.
#include "lib/environment.glsl"
#include "surface/rsm_views.glsl"

layout(local_size_x = 32) in;

layout(std430) writeonly buffer rsm_parallel { vec4 irradiance[]; };

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= views.length()) return;
    const int k_samples = 4096;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < k_samples; ++j) {
        float y = 1.0 - (2.0 * float(j) + 1.0) / float(k_samples), turn = 2.39996322973 * float(j);
        vec3 d = vec3(sqrt(max(1.0 - y * y, 0.0)) * vec2(cos(turn), sin(turn)), y).xzy;
        int nearest = 0;
        for (int i = 1; i < views.length(); ++i)
            if (dot(views[i].direction, d) < dot(views[nearest].direction, d)) nearest = i; // views look away from it
        if (nearest == own) sum += environment(d);
    }
    irradiance[own] = vec4(sum * (12.5663706144 / float(k_samples)), 0.0);
}
