// Footprints of photons as ellipses over the darkened scene: the rim as a line, the inside faint, in the colour of the flux.
#include "lib/frame.glsl"
#include "ldm/photon.glsl"

layout(std430) readonly buffer photons_stored { Photon stored[]; };
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_geometric_normal;

uniform bool background;

flat in int photon_index;
in vec2 corner;
layout(location = 0) out vec4 picture;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (background) {
        float facing = abs(dot(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, normalize(pixel_ray(vec2(pixel)))));
        picture = vec4(0.15 * facing * texelFetch(gbuffer_albedo, pixel, 0).rgb, 1.0);
        return;
    }
    float l = length(corner), width = 1.5 * max(length(dFdx(corner)), length(dFdy(corner)));
    if (l > 1.0) discard;
    vec3 flux = stored[photon_index].flux;
    picture = vec4(flux / max(max(flux.r, max(flux.g, flux.b)), 1.0e-20) * (l > 1.0 - width ? 0.6 : 0.04), 1.0);
}
