// A photon's share of the light at a pixel, added by blending (LDM, Eq. 5).
#include "lib/frame.glsl"
#include "ldm/footprint.glsl"

layout(std430) readonly buffer photons_stored { Photon stored[]; };
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_depth;

flat in int photon_index;
layout(location = 0) out vec4 irradiance; // E/π

void main() {
    ivec2 pixel = splat_pixel(ivec2(gl_FragCoord.xy));
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth <= 0.0) discard;
    Photon photon = stored[photon_index];
    vec3 n = footprint_normal(photon);
    if (dot(n, texelFetch(gbuffer_geometric_normal, pixel, 0).xyz) <= normal_agreement) discard; // it arrived on another side
    float l = footprint_distance(photon, n, world_position(pixel, depth));
    if (l >= 1.0) discard;
    irradiance = vec4(footprint_radiance(photon, l), 1.0);
}
