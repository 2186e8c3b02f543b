// The gather over virtual point lights with imperfect shadow maps (Ritschel et al. 2008, section 5): each texel takes an
// interleaved subset of the lights, asks each light's map whether it is seen, and adds up I·⟨n_p·d⟩⟨n·−d⟩/max(d², c²).
#include "lib/frame.glsl"
#include "lib/interleave.glsl"
#include "surface/start.glsl"
#include "ism/vpl.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer ism_vpls { Vpl vpls[]; };
uniform usampler2D ism_atlas;
layout(FORMAT_ism_irradiance) writeonly uniform image2D ism_irradiance;

uniform int map_side = 64;             //! [8, 512] (texels) width and height of a map
uniform int interleave = 4;            //! [1, 8] (texels) neighbours in blocks of n × n take every n²-th light; 1: all
uniform bool shadows = true;           //! maps are asked; off: every light is seen from everywhere
uniform float bias = 0.005;            //! [0, 0.2] how much nearer a point is taken to be, share of the diagonal
uniform float texel_bias = 0.0;        //! [0, 8] (texels) the same, times the texel's width at the point's distance
uniform float receiver_offset = 0.0;   //! [0, 0.2] a point is moved so far along its normal before its map is asked, share of the diagonal
uniform float nearest = 0.02;          //! [0, 0.5] c: lights count as no nearer than this share of the diagonal

const float k_inverse_pi = 0.318309886184;

bool sees(int v, Vpl vpl, vec3 x) {
    vec3 to = transpose(vpl_frame(vpl.normal)) * (x - vpl.position);
    float away = length(to);
    vec3 d = to / max(away, 1.0e-12);
    if (d.z <= 0.0) return false;
    ivec2 at = clamp(ivec2((to_paraboloid(d) * 0.5 + 0.5) * float(map_side)), ivec2(0), ivec2(map_side - 1));
    uint bits = texelFetch(ism_atlas, map_corner(v, map_side, textureSize(ism_atlas, 0).x / map_side) + at, 0).r;
    float slack = bias * scene_diagonal + texel_bias * away / float(map_side);
    return bits == 0u || 1.0 / uintBitsToFloat(bits) >= away - slack;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(ism_irradiance);
    if (any(greaterThanEqual(texel, size))) return;
    StartPoint own;
    vec3 sum = vec3(0.0);
    if (start_at(pixel_of(texel, size), own)) {
        int stride = interleave * interleave, count = vpls.length();
        float closest = nearest * scene_diagonal;
        vec3 asked = own.position + receiver_offset * scene_diagonal * own.face;
        for (int v = int(interleaved_part(texel, interleave) * float(stride)); v < count; v += stride) {
            Vpl vpl = vpls[v];
            vec3 to = vpl.position - own.position;
            float squared = dot(to, to);
            float cosines = max(dot(own.normal, to), 0.0) * max(-dot(vpl.normal, to), 0.0);
            if (cosines <= 0.0 || (shadows && !sees(v, vpl, asked))) continue;
            sum += vpl.intensity * (cosines / squared / max(squared, closest * closest));
        }
        sum *= float(stride) * k_inverse_pi;
    }
    imageStore(ism_irradiance, texel, vec4(min(sum, vec3(65504.0)), 1.0));
}
