// What the cells hold, as the camera sees it: the proxies as discs (by albedo, by what they send to the camera, by cell), the
// occupied cells as cubes (by how many entries they hold, as a share of the fullest), or each lit cell's light as a ball at its
// centroid, coloured by what it sends in each direction.
#include "lib/frame.glsl"
#include "lib/heat_colour.glsl"
#include "vf/emitters.glsl"
#include "vf/march.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer vf_light { ProxyLight lit[]; };
layout(std430) readonly buffer vf_cells { Cell cells[]; };
layout(FORMAT_debug_vf_grid) writeonly uniform image2D debug_vf_grid;

uniform int quantity = 0;      //! {albedo, flux, cell, cubes, lobes} what is shown
uniform float gain = 1.0;      //! [0.001, 1000] factor on light
uniform float ball_size = 0.3; //! [0.05, 1] lobes: radius of a ball as a share of a cell's shortest side

vec3 colour_of_cell(uint cell) {
    uint x = cell * 0x9e3779b1u;
    x ^= x >> 15;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    return 0.15 + 0.85 * vec3(x & 255u, (x >> 8) & 255u, (x >> 16) & 255u) / 255.0;
}

vec3 disc_colour(int met, vec3 direction) {
    Proxy proxy = proxies[met];
    float facing = 0.3 + 0.7 * abs(dot(proxy.normal, direction));
    if (quantity == quantity_albedo) return facing * proxy.albedo;
    if (quantity == quantity_cell) return facing * colour_of_cell(proxy.cell);
    // A copy of a disc has no light of its own: it is that of its cell's mean.
    vec3 light = dot(proxy.normal, direction) < 0.0 ? lit[met].front.rgb : lit[met].back.rgb;
    if (proxy.area > 0.0) return gain / pre_exposure * light / proxy.area;
    return gain / pre_exposure * cell_intensity(cells[proxy.cell], -direction) / max(cells[proxy.cell].middle.w, 1.0e-20);
}

// The nearest ball of all cells.
vec3 ball_colour(vec3 origin, vec3 direction) {
    float nearest = 3.0e38, radius = ball_size * min(grid.cell.x, min(grid.cell.y, grid.cell.z));
    vec3 colour = vec3(0.02);
    for (int c = 0; c < grid.count; ++c) {
        if (cells[c].c00.a <= 0.0) continue;
        vec3 to = cells[c].middle.xyz - origin;
        float along = dot(to, direction), off = dot(to, to) - along * along;
        if (off > radius * radius) continue;
        float t = along - sqrt(radius * radius - off);
        if (t <= 0.0 || t >= nearest) continue;
        nearest = t;
        vec3 outward = (origin + t * direction - cells[c].middle.xyz) / radius;
        colour = gain / pre_exposure * cell_intensity(cells[c], outward) / max(cells[c].middle.w, 1.0e-20);
    }
    return colour;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_vf_grid)))) return;
    vec3 direction = normalize(pixel_ray(vec2(pixel))), colour = vec3(0.02);
    if (quantity == quantity_lobes) {
        colour = ball_colour(camera_position, direction);
    } else if (quantity == quantity_cubes) {
        GridWalk walk = start_walk(grid.origin, grid.cell, grid.size, camera_position, direction);
        // The walls that face the camera are open: a cell is shown from where the ray leaves an empty one.
        bool empty_before = false;
        while (walk.inside) {
            uvec2 range = entries_of(cell_index(walk.at, grid.size));
            if (range.y > range.x && empty_before) {
                vec3 inside = (camera_position + walk.from * direction - grid.origin) / grid.cell;
                vec3 off = abs(inside - floor(inside + 0.5));
                float edge = off.x + off.y + off.z - max(off.x, max(off.y, off.z)) - min(off.x, min(off.y, off.z));
                colour = heat_colour(0.15 + 0.85 * float(range.y - range.x) / float(max(grid.fullest, 1u))) * (edge < 0.04 ? 0.3 : 1.0);
                break;
            }
            empty_before = empty_before || range.y == range.x;
            next_cell(walk, grid.size);
        }
    } else {
        float t;
        int met = first_disc(camera_position, direction, near_plane, t);
        if (met >= 0) colour = disc_colour(met, direction);
    }
    imageStore(debug_vf_grid, pixel, vec4(colour, 1.0));
}
