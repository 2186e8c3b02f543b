// What the final gather does at one pixel: its cones and each of their spheres, kept for a table and a picture. One
// invocation a cone; the same functions as the gather, with the parameters of the gather (params_of in the graph file).
#include "lrsm/cone_record.glsl"

layout(local_size_x = 128) in; // k_max_recorded_cones

uniform sampler2D lrsm_irradiance;
layout(std430) writeonly buffer debug_cones {
    InspectedPixel inspected;
    RecordedCone cones[k_max_recorded_cones];
    RecordedSphere spheres[];
};

uniform vec2 pixel = vec2(0.5);  //! [0, 1] the inspected pixel, as shares of width and height from the top left

// Called by light_along_cone and sample_view.
int kept = 0, seen = 0, seen_layers = 0;
float seen_level = -1.0, seen_end = 0.0;
void keep_sphere(bool at_hit, vec3 centre, float t, float diameter, float alpha, float level, float share, vec3 light) {
    ++seen;
    seen_end = t;
    if (kept < k_max_recorded_spheres) {
        int place = int(gl_LocalInvocationIndex) * k_max_recorded_spheres + kept++;
        spheres[place] = RecordedSphere(centre, t, diameter, alpha, share, level, light, seen_level, seen_layers, at_hit ? 1 : 0, 0, 0);
    }
    seen_layers = 0;
    seen_level = -1.0;
}
#define SEE_SPHERE(at_hit, centre, t, diameter, alpha, level, share, light) keep_sphere(at_hit, centre, t, diameter, alpha, level, share, light)
#define SEE_STEP(centre, t, diameter, alpha, level) keep_sphere(false, centre, t, diameter, alpha, level, 0.0, vec3(0.0))
#define SEE_LAYER(level) (++seen_layers, seen_level = (level))
#include "lrsm/gather_cones.glsl"

shared vec4 weighted[k_max_recorded_cones];

void main() {
    int i = int(gl_LocalInvocationIndex);
    ivec2 size = textureSize(lrsm_irradiance, 0);
    ivec2 texel = clamp(ivec2(pixel * vec2(size)), ivec2(0), size - 1);
    ivec2 at = gather_pixel(texel, size);
    VoxelGrid grid = cone_grid();
    GatherPoint point;
    bool surface = gather_point(grid, texel, at, point);
    int count = surface ? gather_cone_count() : 0;
    if (i < count) {
        float diameter = 2.0 * tan(radians(0.5 * aperture));
        vec4 cone;
        vec4 traced = gather_cone(grid, point, i, diameter, cone);
        weighted[i] = cone.w * traced;
        cones[i] = RecordedCone(cone.xyz, cone.w, traced.rgb, traced.a, i * k_max_recorded_spheres, kept, seen, seen_end, diameter, 0.0, 0.0, 0.0);
    }
    barrier();
    if (i != 0) return;
    vec4 sum = vec4(0.0); // in the gather's order
    for (int k = 0; k < count; ++k)
        sum += weighted[k];
    vec4 summed = surface ? vec4(sum.rgb, 1.0 - sum.a) : vec4(0.0);
    inspected = InspectedPixel(at, texel, surface ? point.start.apex : vec3(0.0), count, summed, texelFetch(lrsm_irradiance, texel, 0));
}
