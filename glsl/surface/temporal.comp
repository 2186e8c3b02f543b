// Accumulation over frames of what a gather made, before it is filtered: the running mean of as many frames as hold at each
// texel. The history is found where the texel's surface was a frame ago, by the camera's motion and the object's own, and is
// dropped where another surface was seen there. Where something in the scene moves by itself, it is clamped to what this
// frame's neighbourhood says (Salvi 2016), and then counts for fewer frames. What somebody edits ends it at once: the graph
// then clears it. Of what stands, the plain mean is kept: it converges to what ever more samples would give.
#include "lib/frame.glsl"
#include "surface/gbuffer_surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D temporal_input;  // this frame's
uniform sampler2D gbuffer_motion;  //! optional // to where the surface was a frame ago, metres
layout(FORMAT_temporal_output) writeonly uniform image2D temporal_output; // the mean
layout(FORMAT_temporal_frames) writeonly uniform image2D temporal_frames; //! neutral 1 // how many it holds
// Of two frames in turn: the mean; then position, and in a the frames that the mean holds.
layout(FORMAT_temporal_history) uniform image2DArray temporal_history; //! ordered: layers of this frame are written and of the last one read
layout(std430) buffer temporal_counts { uint max_frames_held, held_texels, seen_texels; };

uniform int turn;             // 0 or 1: which of the two is written
uniform bool something_moves; // objects or lights, by themselves

uniform int max_frames = 1024;      //! [1, 65536] frames that the mean reaches back
uniform int max_moving_frames = 2;  //! [1, 65536] the same where something moves by itself; more: less noise, and ghosts
uniform float clamp_width = 1.0;    //! [0, 16] (standard deviations) how far history may be from the neighbourhood's mean
uniform float plane_distance = 0.01; //! [1e-4, 1] history farther from the surface's plane is dropped, share of the view distance

ivec2 pixel_of(ivec2 texel, ivec2 size) {
    return min((2 * texel + 1) * resolution / (2 * size), resolution - 1);
}

// Mean and deviation of this frame around the texel, on its own surface.
void neighbourhood(ivec2 texel, ivec2 size, vec3 position, vec3 n, float tolerance, out vec3 mean, out vec3 deviation) {
    vec3 sum = vec3(0.0), squares = vec3(0.0);
    float count = 0.0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            ivec2 at = clamp(texel + ivec2(x, y), ivec2(0), size - 1), pixel = pixel_of(at, size);
            float depth = texelFetch(gbuffer_depth, pixel, 0).r;
            if (depth <= 0.0 || abs(dot(n, world_position(pixel, depth) - position)) > tolerance) continue;
            vec3 value = texelFetch(temporal_input, at, 0).rgb;
            sum += value;
            squares += value * value;
            count += 1.0;
        }
    }
    mean = sum / max(count, 1.0);
    deviation = sqrt(max(squares / max(count, 1.0) - mean * mean, vec3(0.0)));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(temporal_input, 0);
    if (any(greaterThanEqual(texel, size))) return;
    ivec2 pixel = pixel_of(texel, size);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec4 now = texelFetch(temporal_input, texel, 0);
    if (depth <= 0.0) {
        imageStore(temporal_output, texel, now);
        imageStore(temporal_frames, texel, vec4(1.0));
        imageStore(temporal_history, ivec3(texel, turn), now);
        imageStore(temporal_history, ivec3(texel, 2 + turn), vec4(0.0));
        return;
    }
    vec3 position = world_position(pixel, depth), n = normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
    vec3 before = position;
#ifdef HAS_gbuffer_motion
    before += texelFetch(gbuffer_motion, pixel, 0).xyz;
#endif
    float tolerance = plane_distance * length(position - camera_position);
    vec4 clip = previous_view_projection * vec4(before, 1.0);
    // In texels of the history: a texel's sample is not at its middle, but at that of the pixel that it stands for.
    vec2 scale = vec2(size) / vec2(resolution);
    vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * vec2(size) - (vec2(pixel) + 0.5) * scale + vec2(texel);
    vec2 nearest = round(at);
    if (all(lessThan(abs(at - nearest), vec2(0.02)))) at = nearest; // nothing moved: nothing is blurred
    vec4 mean = vec4(0.0);
    float frames = 0.0, total = 0.0;
    for (int k = 0; clip.w > 0.0 && k < 4; ++k) {
        ivec2 corner = ivec2(floor(at)) + ivec2(k & 1, k >> 1);
        vec2 part = 1.0 - abs(vec2(corner) - at);
        float weight = part.x * part.y;
        if (weight <= 0.0 || any(lessThan(corner, ivec2(0))) || any(greaterThanEqual(corner, size))) continue;
        vec4 surface = imageLoad(temporal_history, ivec3(corner, 3 - turn));
        if (surface.a <= 0.0 || abs(dot(n, surface.xyz - before)) > tolerance) continue;
        mean += weight * imageLoad(temporal_history, ivec3(corner, 1 - turn));
        frames += weight * surface.a;
        total += weight;
    }
    if (total > 0.05) {
        mean /= total;
        frames /= total;
    } else {
        frames = 0.0;
    }
    if (something_moves && frames > 0.0) {
        vec3 middle, deviation;
        neighbourhood(texel, size, position, n, tolerance, middle, deviation);
        vec3 range = clamp_width * deviation + 1.0e-3 * middle, clamped = clamp(mean.rgb, middle - range, middle + range);
        vec3 off = abs(clamped - mean.rgb) / max(range, vec3(1.0e-20));
        frames = min(frames, float(max_moving_frames) - 1.0) / (1.0 + 4.0 * max(off.r, max(off.g, off.b)));
        mean.rgb = clamped;
    }
    frames = min(frames + 1.0, float(max_frames));
    mean = mix(mean, now, 1.0 / frames);
    imageStore(temporal_output, texel, mean);
    imageStore(temporal_frames, texel, vec4(frames));
    imageStore(temporal_history, ivec3(texel, turn), mean);
    imageStore(temporal_history, ivec3(texel, 2 + turn), vec4(position, frames));
    atomicMax(max_frames_held, uint(frames));
    atomicAdd(seen_texels, 1u);
    if (frames >= 1.5) atomicAdd(held_texels, 1u);
}
