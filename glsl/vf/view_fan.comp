// The rays of one texel and its visibility list over the picture: surfaces in cells of its own list are orange, in cells that
// only the filter adds blue (brighter where more of the crossing rays saw them), all others dark. Rays end at the discs that they
// meet; those that slip through all of them are red.
#include "lib/view_segment.glsl"
#include "vf/grid.glsl"
#include "vf/lists.glsl"
#include "vf/ray_record.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D out_display;
uniform sampler2D gbuffer_depth;
layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) readonly buffer vf_sizes { ivec2 march_size; int list_capacity, filtered_capacity; };
layout(std430) readonly buffer vf_lists { uint lists[]; };
layout(std430) readonly buffer vf_filtered { uint filtered[]; };
layout(std430) readonly buffer debug_fan { RecordedFan record; };
layout(FORMAT_debug_vf_fan) writeonly uniform image2D debug_vf_fan;

uniform float line_width = 1.0; //! [0.5, 8] (pixels) of rays

shared ViewSegment segments[k_max_recorded_rays];

// Where the cell's entry is, or −1.
int find_in_own(uint cell) {
    int from = list_start(record.fan.texel, march_size, list_capacity);
    for (int k = 0; k < int(lists[from]); ++k)
        if (lists[from + k_list_header + 2 * k] == cell) return from + k_list_header + 2 * k + 1;
    return -1;
}
int find_in_filtered(uint cell) {
    int from = list_start(record.fan.texel, march_size, filtered_capacity);
    for (int k = 0; k < int(filtered[from]); ++k)
        if (filtered[from + k_list_header + 2 * k] == cell) return from + k_list_header + 2 * k + 1;
    return -1;
}

void main() {
    int lane = int(gl_LocalInvocationIndex);
    bool any_surface = record.fan.texel.x >= 0;
    if (lane < k_max_recorded_rays) {
        vec4 ray = record.ray[lane];
        segments[lane] = view_segment(record.fan.origin.xyz, record.fan.origin.xyz + (ray.w > 0.0 ? ray.w : scene_diagonal) * ray.xyz);
        if (ray.xyz == vec3(0.0) || lane >= record.fan.rays) segments[lane].nearness = vec2(-1.0);
    }
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_vf_fan)))) return;
    vec3 colour = 0.25 * decoded(texelFetch(out_display, pixel, 0).rgb);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r, surface = depth > 0.0 ? near_plane / depth : 1.0e30;
    if (depth > 0.0 && any_surface) {
        ivec3 at = ivec3(floor((world_position(pixel, depth) - grid.origin) / grid.cell));
        uint cell = cell_index(at, grid.size);
        int own = in_grid(at, grid.size) ? find_in_own(cell) : -1, joined = in_grid(at, grid.size) ? find_in_filtered(cell) : -1;
        if (joined >= 0) {
            uvec2 counts = unpacked_counts(filtered[joined]);
            float share = 0.25 + 0.75 * float(counts.x) / float(max(counts.y, 1u));
            colour = mix(colour, own >= 0 ? vec3(0.9, 0.4, 0.05) : vec3(0.1, 0.35, 0.9), 0.45 * share) + 0.05;
        }
    }
    vec2 here = vec2(pixel) + 0.5;
    for (int i = 0; i < record.fan.rays; ++i) {
        bool behind;
        float cover = segment_cover(segments[i], here, line_width, surface, behind);
        colour = mix(colour, record.ray[i].w > 0.0 ? vec3(1.0, 0.9, 0.5) : vec3(1.0, 0.05, 0.05), cover * (behind ? 0.15 : 0.7));
    }
    if (any_surface && on_pixel_cross(here, (2 * record.fan.texel + 1) * resolution / (2 * march_size))) colour = vec3(1.0, 1.0, 0.2);
    imageStore(debug_vf_fan, pixel, vec4(colour, 1.0));
}
