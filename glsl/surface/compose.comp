// The sum of all parts: out.radiance = direct + emitted + environment + indirect diffuse + indirect specular + emission.
// A part that no pass makes reads as 0.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D out_direct;             //! optional
uniform sampler2D out_emitted;            //! optional
uniform sampler2D out_environment;        //! optional
uniform sampler2D out_indirect_diffuse;   //! optional
uniform sampler2D out_indirect_specular;  //! optional
uniform sampler2D out_emission;           //! optional
layout(FORMAT_out_radiance) writeonly uniform image2D out_radiance;

// A neutral texture has one texel only.
vec3 part(sampler2D which, ivec2 pixel) {
    return texelFetch(which, min(pixel, textureSize(which, 0) - 1), 0).rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_radiance)))) return;
    vec3 sum = part(out_direct, pixel) + part(out_emitted, pixel) + part(out_environment, pixel) +
               part(out_indirect_diffuse, pixel) + part(out_indirect_specular, pixel) + part(out_emission, pixel);
    imageStore(out_radiance, pixel, vec4(min(sum, vec3(65504.0)), 1.0));
}
