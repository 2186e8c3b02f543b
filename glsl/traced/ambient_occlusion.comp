// Ambient occlusion by traced rays with the density of the cosine, 1 = open: out.ambient_occlusion counts all that is met,
// out.ambient_occlusion_dmax what lies within d_max; as obscurance (falloff quadratic), visibility grows with the distance r
// to what is met instead: (r/d_max)², r < d_max.
#include "lib/frame.glsl"
#include "voxel/directions.glsl"
#include "surface/start.glsl"
#include "traced/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_traced_openness) writeonly uniform image2D traced_openness;

uniform int rays = 16;     //! [1, 64] per texel
uniform float d_max = 0.1; //! [1e-4, 10] (scene diagonals) occluders further away do not count for out.ambient_occlusion_dmax
uniform int falloff = 0;   //! {none, quadratic} what lies within d_max occludes in full, or by 1 − (r/d_max)² (obscurance)

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(traced_openness);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint start;
    vec2 open = vec2(float(rays));
    if (start_at(pixel_of(texel, size), start)) {
        SamplePattern which = pattern_at(texel);
        mat3 frame = frame_around(start.normal);
        float max_distance = d_max * scene_diagonal;
        for (int i = 0; i < rays; ++i) {
            vec3 direction = frame * direction_of(which, i, rays);
            uint seed = hash_combine(uint(texel.x) | (uint(texel.y) << 16), uint(i)) | 1u;
            if (dot(direction, start.face) <= 0.0) {
                open -= 1.0; // the surface itself is in the way
                continue;
            }
            TracedHit hit = trace_nearest(start.origin, direction, 3.0e38, seed);
            if (hit.draw == k_nothing) continue;
            open.x -= 1.0;
            if (hit.t < max_distance) open.y -= falloff == 1 ? 1.0 - hit.t * hit.t / (max_distance * max_distance) : 1.0;
        }
    }
    imageStore(traced_openness, texel, vec4(open / float(rays), 0.0, 0.0));
}
