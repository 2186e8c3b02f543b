// What the cells hold, as the camera sees it: each as a ball in its middle, coloured toward each direction by what it sends there
// (light: the result; wave: the last iteration alone, so that graph.iterations goes through them one by one), by what of light
// that goes there is stopped (blocking), or by how many of its links are crossed. One cascade, or one slice of it.
#include "lib/frame.glsl"
#include "lib/heat_colour.glsl"
#include "lpv/light.glsl"

uniform int quantity = 0;  //! static {light, wave, blocking, links} what is shown
uniform int angular = 0;   //! static {sh, ordinates} of the light

#include "lpv/grid.glsl"
#if quantity == quantity_links
#include "lpv/links.glsl"
#endif
#if quantity == quantity_blocking
layout(std430) readonly buffer lpv_blocking { vec4 blockers[]; };
#include "lpv/blocking.glsl"
#endif
#if quantity == quantity_wave
layout(std430) readonly buffer lpv_light { mat3x4 light[]; };
#endif
#if quantity == quantity_light
#if angular == angular_sh
layout(std430) readonly buffer lpv_sum { mat3x4 sums[]; };
#endif
#if angular == angular_ordinates
#include "lpv/ordinates.glsl"
layout(std430) readonly buffer lpv_ordinates { uvec2 ordinates[]; };
#endif
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_lpv_cells) writeonly uniform image2D debug_lpv_cells;

uniform int cascade = 0;       //! [0, 3] which cascade, the finest first
uniform float gain = 1.0;      //! [0.001, 1000] factor on light
uniform float ball_size = 0.6; //! [0.05, 1] width of a ball as a share of a cell
uniform int slice = 0;         //! {all, x, y, z} only the cells of one slice across an axis
uniform float at_slice = 0.5;  //! [0, 1] where along the axis, as a share of the grid
uniform int iterations = 8;    //! [1, 128] quantity wave: how many were made

int cascade_shown() {
    return min(cascade, grid_cascades - 1);
}

// Each writes the colour toward `outward`; false: the cell is empty, and so has no ball.
#if quantity == quantity_links
bool colour_of(int cell, ivec3 at, vec3 outward, out vec3 colour) {
    int crossed = 0;
    for (int k = 0; k < 27; ++k) {
        ivec3 step = ivec3(k % 3, k / 3 % 3, k / 9) - 1;
        if (in_grid(at + step, grid_size()) && is_blocked(cascade_shown(), at, step)) ++crossed;
    }
    colour = heat_colour(float(crossed) / 26.0);
    return crossed > 0;
}
#endif
#if quantity == quantity_blocking
bool colour_of(int cell, ivec3 at, vec3 outward, out vec3 colour) {
    vec4 blocker = blockers[blocker_index(cascade_shown(), at)];
    colour = heat_colour(blocked_share(blocker, outward));
    return blocker.w > 0.0;
}
#endif
bool lobe_colour(mat3x4 lobe, vec3 outward, out vec3 colour) {
    colour = gain / pre_exposure * max(harmonics_of(outward) * lobe, vec3(0.0));
    return max(lobe[0].x, max(lobe[1].x, lobe[2].x)) > 0.0;
}
#if quantity == quantity_wave
bool colour_of(int cell, ivec3 at, vec3 outward, out vec3 colour) {
    return lobe_colour(light[(iterations & 1) * (light.length() / 2) + cell], outward, colour);
}
#endif
#if quantity == quantity_light
#if angular == angular_sh
bool colour_of(int cell, ivec3 at, vec3 outward, out vec3 colour) {
    return lobe_colour(sums[cell], outward, colour);
}
#endif
#if angular == angular_ordinates
bool colour_of(int cell, ivec3 at, vec3 outward, out vec3 colour) {
    float nearest = -2.0;
    int found = 0;
    for (int m = 0; m < directions; ++m) {
        float cosine = dot(ordinate(m), outward);
        if (cosine > nearest) nearest = cosine, found = m;
    }
    colour = gain / pre_exposure * unpacked_light(ordinates[found * grid_cascades * cells_of_cascade() + cell]);
    return true;
}
#endif
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_lpv_cells)))) return;
    vec3 direction = normalize(pixel_ray(vec2(pixel))), colour = vec3(0.02);
    Cascade shown = cascades[cascade_shown()];
    // The geometry volume's cells lie about the corners of the light's.
    float off = quantity == quantity_blocking ? -0.5 : 0.0;
    ivec3 size = grid_size() + (quantity == quantity_blocking ? 1 : 0);
    vec3 origin = shown.anchor + shown.cell * (vec3(shown.base) + off);
    GridWalk walk = start_walk(origin, vec3(shown.cell), size, camera_position, direction);
    float radius = 0.5 * ball_size * shown.cell;
    while (walk.inside) {
        bool chosen = slice == slice_all || walk.at[slice - 1] == min(int(at_slice * float(size.x)), size.x - 1);
        vec3 middle = origin + shown.cell * (vec3(walk.at) + 0.5), to = middle - camera_position;
        float along = dot(to, direction), beside = dot(to, to) - along * along, t = along - sqrt(max(radius * radius - beside, 0.0));
        if (chosen && beside <= radius * radius && t > 0.0) {
            vec3 ball;
            int cell = cascade_shown() * cells_of_cascade() + int(cell_index(min(walk.at, grid_size() - 1), grid_size()));
            if (colour_of(cell, walk.at, (t * direction - to) / radius, ball)) {
                colour = ball;
                break;
            }
        }
        next_cell(walk, size);
    }
    imageStore(debug_lpv_cells, pixel, vec4(colour, 1.0));
}
