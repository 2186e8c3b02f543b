#ifndef LPV_START_CELL_GLSL
#define LPV_START_CELL_GLSL
// In which cell a texel's light starts (LPV, section 3.2): that of its place, moved along its normal by half a cell, so that no
// light starts behind its own surface.
#include "surface/map_texel.glsl"
#include "lpv/grid.glsl"

uniform float shift = 0.5;     //! [0, 1] (cells) how far light is moved along its surface's normal
uniform int start = 0;         //! {shifted, in_front, lit} the cell where light starts: as shifted (published), before its surface, or there seen by the light

// Whether nothing that the map shows lies between the light and x.
bool is_lit(int view, vec3 x) {
    vec4 clip = views[view].view_projection * vec4(x, 1.0);
    ivec2 size = textureSize(rsm_depth, 0).xy, at = ivec2(floor((clip.xy / clip.w * 0.5 + 0.5) * vec2(size)));
    if (clip.w <= 0.0 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) return false;
    return dot(x - views[view].origin, views[view].direction) <= shadow_distance(views[view], texelFetch(rsm_depth, ivec3(at, view), 0).r);
}

ivec3 start_cell(Cascade cascade, MapTexel texel, int view) {
    ivec3 at = cell_at(cascade, texel.position, shift * texel.normal);
    if (start == start_shifted) return at;
    // Of the eight cells around, the nearest. The way from the texel to the light is free, so what the light sees is on its side.
    if (start == start_lit) {
        ivec3 low = cell_at(cascade, texel.position, shift * texel.normal - 0.5);
        float nearest = 3.0e38;
        int found = -1;
        for (int k = 0; k < 8; ++k) {
            vec3 to = cell_middle(cascade, low + ivec3(k & 1, k >> 1 & 1, k >> 2)) - texel.position;
            if (dot(to, texel.normal) <= 0.0 || dot(to, to) >= nearest || !is_lit(view, texel.position + to)) continue;
            nearest = dot(to, to);
            found = k;
        }
        if (found >= 0) return low + ivec3(found & 1, found >> 1 & 1, found >> 2);
    }
    return dot(cell_middle(cascade, at) - texel.position, texel.normal) > 0.0 ? at : cell_at(cascade, texel.position, (shift + 0.5) * texel.normal);
}
#endif
