// Diffuse indirect light by traced rays: at each texel's surface the mean of what N rays meet, with the density of the
// cosine (E/π). a = 1 − occlusion.
#include "lib/frame.glsl"
#include "traced/directions.glsl"
#include "traced/light.glsl"
#include "traced/start.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_traced_irradiance) writeonly uniform image2D traced_irradiance;

uniform int rays = 16; //! [1, 64] per texel

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(traced_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint start;
    if (!start_at(pixel_of(texel, size), start)) {
        imageStore(traced_irradiance, texel, vec4(0.0));
        return;
    }
    Directions set = directions_at(texel, rays);
    mat3 frame = frame_around(start.normal);
    vec3 sum = vec3(0.0);
    float met = 0.0;
    for (int i = 0; i < rays; ++i) {
        vec3 direction = frame * direction_of(set, i);
        if (dot(direction, start.face) <= 0.0) continue;
        uint seed = hash_combine(uint(texel.x) | (uint(texel.y) << 16), uint(i)) | 1u;
        TracedHit hit = trace_nearest(start.origin, direction, 3.0e38, seed);
        if (hit.draw == k_nothing) continue;
        TracedSurface s = surface_at(hit, direction, 0.0, false);
        sum += scattered_light(s, -direction, true, seed);
        met += 1.0;
    }
    imageStore(traced_irradiance, texel, vec4(min(sum / float(rays), vec3(65504.0)), 1.0 - met / float(rays)));
}
