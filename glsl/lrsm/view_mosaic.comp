// The stored layers as a mosaic: a row a layer of the pool, a column a mip, each tile magnified or thinned to the same
// size without filtering. Attributes are divided by the opacity that they are stored with. Texels that hold nothing are
// dark grey; a tile that holds nothing at all is crossed out in red, a place of the pool that holds no layer is hatched.
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray lrsm_radiance;
uniform sampler2DArray lrsm_normal;
uniform sampler2DArray lrsm_depth;
layout(std430) readonly buffer lrsm_summary { int summary[]; };
layout(FORMAT_debug_lrsm) writeonly uniform image2D debug_lrsm;

uniform int quantity = 0;    //! {radiance, normal, depth, opacity, variance} normal: ½ + ½n; depth: from its layer's near to its far end; variance: of that
uniform float gain = 1.0;    //! [0.001, 1000] factor on it
uniform int tile = 128;      //! [8, 1024] (pixels) side of a tile; one more on each side is border

vec3 attribute_at(ivec3 at, int mip) {
    vec4 normal = texelFetch(lrsm_normal, at, mip);
    vec4 depth = texelFetch(lrsm_depth, at, mip);
    if (normal.a <= 0.0) return vec3(0.03);
    float mean = depth.r / max(depth.b, 1.0e-6);
    if (quantity == quantity_radiance) return gain / pre_exposure * texelFetch(lrsm_radiance, at, mip).rgb / normal.a;
    if (quantity == quantity_normal) return gain * (0.5 + 0.5 * normal.xyz / normal.a);
    if (quantity == quantity_depth) return vec3(gain * mean);
    if (quantity == quantity_opacity) return vec3(gain * normal.a);
    return vec3(gain * max(depth.g / max(depth.b, 1.0e-6) - mean * mean, 0.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_lrsm)))) return;
    int cell = tile + 2;
    int layer = pixel.y / cell, mip = pixel.x / cell;
    ivec2 inside = pixel - cell * ivec2(mip, layer) - 1;
    int mips = textureQueryLevels(lrsm_normal);
    bool border = any(lessThan(inside, ivec2(0))) || any(greaterThanEqual(inside, ivec2(tile)));
    inside = clamp(inside, ivec2(0), ivec2(tile - 1));
    // A loop that all invocations go through alike, since some software drivers take the mip of a group's first for all.
    vec3 colour = vec3(0.0);
    for (int i = 0; i < mips; ++i) {
        vec3 here = attribute_at(ivec3(inside * textureSize(lrsm_normal, i).xy / tile, layer), i);
        if (i == mip) colour = here;
    }
    // The coarsest mip holds something wherever a finer one does.
    bool bare = texelFetch(lrsm_normal, ivec3(0, 0, layer), mips - 1).a <= 0.0;
    bool on_cross = min(abs(inside.x - inside.y), abs(inside.x + inside.y - tile + 1)) <= 1;
    if (bare && on_cross) colour = vec3(0.8, 0.05, 0.03);
    if (layer >= summary[0]) colour = vec3((inside.x + inside.y) / 4 % 4 == 0 ? 0.12 : 0.01);
    if (border) colour = vec3(0.15);
    imageStore(debug_lrsm, pixel, vec4(colour, 1.0));
}
