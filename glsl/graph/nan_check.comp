// Counts the components of a texture's mip 0 that are NaN or infinite.
#ifndef TEXTURE_KIND
#define TEXTURE_KIND 0
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#if TEXTURE_KIND == 0
uniform sampler2D checked_texture;
#elif TEXTURE_KIND == 1
uniform sampler2DArray checked_texture;
#else
uniform sampler3D checked_texture;
#endif
layout(std430) buffer checked_count { uint count; };

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
#if TEXTURE_KIND == 0
    if (any(greaterThanEqual(at.xy, textureSize(checked_texture, 0)))) return;
    vec4 value = texelFetch(checked_texture, at.xy, 0);
#else
    if (any(greaterThanEqual(at, textureSize(checked_texture, 0)))) return;
    vec4 value = texelFetch(checked_texture, at, 0);
#endif
    uint bad = 0u;
    for (int i = 0; i < 4; ++i) bad += (isnan(value[i]) || isinf(value[i])) ? 1u : 0u;
    if (bad > 0u) atomicAdd(count, bad);
}
