// What the camera's rays cost: nodes visited, or triangles tested, per pixel, from black over blue and red to white at
// `max_count`. a: the count itself.
#define TRACED_COUNTS
#include "lib/frame.glsl"
#include "lib/heat_colour.glsl"
#include "traced/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(FORMAT_debug_cost) writeonly uniform image2D debug_cost;

uniform int quantity = 0;   //! {nodes, triangles} that are counted
uniform float max_count = 300.0; //! [1, 100000] count that is white

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_cost)))) return;
    trace_nearest(camera_position, normalize(pixel_ray(vec2(pixel))), 3.0e38, 0u);
    float count = float(quantity == 0 ? visited_nodes : tested_triangles);
    imageStore(debug_cost, pixel, vec4(heat_colour(count / max_count), count));
}
