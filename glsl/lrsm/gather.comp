// Final gather of diffuse indirect light (LRSM, section 5): a set of cones over the hemisphere of each pixel's surface.
// Writes the mean radiance from there, weighted by the cosine (E/π): times the albedo it is what the surface sends on.
// a = 1 − occlusion.
#include "lrsm/gather_cones.glsl"
#include "lib/environment.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform bool sky_light = false; //! static what nothing blocks brings light of the environment (lrsm.sky); off as published

layout(FORMAT_lrsm_irradiance) writeonly uniform image2D lrsm_irradiance;
#if sky_light
layout(FORMAT_lrsm_sky) writeonly uniform image2D lrsm_sky; // the environment's E/π
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(lrsm_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    VoxelGrid grid = cone_grid();
    GatherPoint point;
    if (!gather_point(grid, texel, gather_pixel(texel, size), point)) {
        imageStore(lrsm_irradiance, texel, vec4(0.0));
#if sky_light
        imageStore(lrsm_sky, texel, vec4(0.0));
#endif
        return;
    }
    float diameter = 2.0 * tan(radians(0.5 * aperture));
    vec4 sum = vec4(0.0);
    vec3 open = vec3(0.0);
    for (int i = 0; i < gather_cone_count(); ++i) {
        vec4 cone;
        vec4 traced = gather_cone(grid, point, i, diameter, cone);
        sum += cone.w * traced;
        if (sky_light && dot(cone.xyz, point.start.face) > 0.0) open += cone.w * (1.0 - traced.a) * environment(cone.xyz);
    }
    imageStore(lrsm_irradiance, texel, vec4(min(sum.rgb, vec3(65504.0)), 1.0 - sum.a));
#if sky_light
    imageStore(lrsm_sky, texel, vec4(min(open, vec3(65504.0)), 1.0));
#endif
}
