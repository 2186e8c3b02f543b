// The map that one pixel looks into, what its texels send on, and over it the samples that the pixel takes: their brightness
// is their weight. A cross marks the pixel's own place in the map.
#include "rsm/gather_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
layout(FORMAT_debug_rsm_pattern) writeonly uniform image2D debug_rsm_pattern;

uniform vec2 pixel = vec2(0.5); //! [0, 1] the inspected pixel, as shares of width and height from the top left
uniform int view_index = 0;     //! [0, 1024] which map
uniform float gain = 1.0;       //! [0.001, 1000] factor on the map's radiance
uniform float dot_size = 1.5;   //! [0.5, 8] (pixels) radius of a sample

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(debug_rsm_pattern);
    if (any(greaterThanEqual(at, size))) return;
    ivec3 map = textureSize(rsm_radiance, 0);
    int v = min(view_index, map.z - 1);
    vec2 here = vec2(at) + 0.5;
    vec3 colour = 0.5 * gain / pre_exposure * texelFetch(rsm_radiance, ivec3(here / vec2(size) * vec2(map.xy), v), 0).rgb;
    ivec2 asked = clamp(ivec2(pixel * vec2(resolution)), ivec2(0), resolution - 1);
    float depth = texelFetch(gbuffer_depth, asked, 0).r;
    vec2 centre = vec2(0.5);
    if (depth > 0.0 && v < shadow_view_count) {
        bool seen = place_in_map(views[v], world_position(asked, depth), centre);
        if (pattern != pattern_every_texel && (pattern == pattern_whole_map || seen)) {
            float largest = pattern == pattern_whole_map ? 1.0 : 3.14159265359 * radius * radius * (weight == weight_squared ? 3.0 : 2.0);
            for (int i = 0; i < samples; ++i) {
                vec3 s = rsm_sample(i, centre, interleaved_part(asked, interleave), 1.0);
                float cover = clamp(dot_size + 0.5 - distance(s.xy * vec2(size), here), 0.0, 1.0);
                colour = mix(colour, vec3(1.0, 0.55, 0.1), cover * (0.15 + 0.85 * clamp(s.z * float(samples) / largest, 0.0, 1.0)));
            }
        }
        vec2 apart = abs(centre * vec2(size) - here);
        if (seen && min(apart.x, apart.y) < 0.6 && max(apart.x, apart.y) < 8.0) colour = vec3(1.0, 1.0, 0.2);
    }
    imageStore(debug_rsm_pattern, at, vec4(colour, 1.0));
}
