// Light of the proxies (VF, section 3.1): what the punctual lights send to each, by their shadow maps, makes it a virtual point
// light of intensity I = ρ·E·⟨n·l⟩/π · A along its normal. Each side keeps its own: a thin wall sends on to the side that is lit.
#define SCENE_LIGHTS
#include "lib/frame.glsl"
#include "lib/material_model.glsl"
#include "lib/scene.glsl"
#include "lib/shadow.glsl"
#include "vf/grid.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer vf_proxies { Proxy proxies[]; };
layout(std430) writeonly buffer vf_light { ProxyLight lit[]; };
uniform sampler2DArray shadow_depth;
layout(std430) readonly buffer shadow_views { ShadowView views[]; };

uniform float normal_offset = 0.125; //! [0, 16] (texels) how far a proxy is moved along its normal before it is looked up
uniform float depth_bias = 0.3;      //! [0, 16] (texels) how much nearer to the light a proxy is taken to be

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= proxies.length()) return;
    Proxy proxy = proxies[i];
    vec3 front = vec3(0.0), back = vec3(0.0);
    for (int k = 0; k < light_count && proxy.area > 0.0; ++k) {
        Light light = lights[k];
        vec3 l;
        vec3 irradiance = light_irradiance(light, proxy.position, l);
        float cosine = dot(proxy.normal, l);
        vec3 facing = cosine < 0.0 ? -proxy.normal : proxy.normal;
        if (cosine == 0.0 || max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0) continue;
        if (light.shadow_base >= 0) {
            int layer = shadow_layer(light, proxy.position);
            irradiance *= shadow_visibility(shadow_depth, views[layer], layer, proxy.position, facing, normal_offset, depth_bias, 0, true);
        }
        vec3 sent = proxy.albedo * irradiance * (abs(cosine) * diffuse_share(abs(cosine)) / k_pi);
        if (cosine > 0.0) front += sent;
        else back += sent;
    }
    lit[i] = ProxyLight(vec4(front * proxy.area, 0.0), vec4(back * proxy.area, 0.0));
}
