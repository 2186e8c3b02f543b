// The rays of one pixel through all maps, kept for a picture. One invocation a map, in the step that holds it; the same
// functions as the ambient occlusion, with its parameters (params_of in the graph file).
#include "lib/frame.glsl"
#include "ldm/surface_ray.glsl"
#include "ldm/trace_record.glsl"

layout(local_size_x = 64) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform int iteration;
layout(std430) writeonly buffer debug_rays {
    TracedPixel traced;
    RecordedRay rays[];
};

uniform vec2 pixel = vec2(0.5);  //! [0, 1] the inspected pixel, as shares of width and height from the top left

void main() {
    int slot = int(gl_GlobalInvocationID.x);
    ivec2 at = clamp(ivec2(pixel * vec2(resolution)), ivec2(0), resolution - 1);
    float depth = texelFetch(gbuffer_depth, at, 0).r;
    vec3 x = depth > 0.0 ? world_position(at, depth) : vec3(0.0);
    if (slot == 0) traced = TracedPixel(x, depth > 0.0 ? ldm.maps : 0, at, ivec2(0));
    if (depth <= 0.0 || slot >= batch_maps(iteration)) return;
    vec3 n = normalize(texelFetch(gbuffer_normal, at, 0).xyz);
    vec3 face = normalize(texelFetch(gbuffer_geometric_normal, at, 0).xyz);
    int map = iteration + slot * ldm.batches;
    LdmRay ray;
    if (!ldm_surface_ray(slot, views[map], x, n, face, ray)) ray.cosine = 0.0;
    rays[map] = RecordedRay(ray.direction, ray.distance, ray.cosine, 0.0, 0.0, 0.0);
}
