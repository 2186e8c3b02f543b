#ifndef LIB_COVERAGE_GLSL
#define LIB_COVERAGE_GLSL
// Whether a surface is there at a place, by its alpha. MASK: where alpha reaches the cutoff. BLEND: with the probability
// alpha, by a hash of the place and of the surface (hashed alpha testing, Wyman & McGuire 2017): where alpha reaches a
// threshold drawn evenly from (0, 1], so always at 1 and never at 0. One surface behind another draws anew, so that k layers
// let (1 − α)^k through in the mean. passes/scene/coverage.h mirrors the threshold.
// Include lib/scene.glsl before this file.

#include "lib/hash.glsl"

float coverage_threshold(uint bits) {
    return min(float((bits >> 8) + 1u) / 16777216.0, 0.999999);
}

// A little short of the cutoff, likewise.
float mask_threshold(float cutoff) {
    return cutoff - 1.0e-6;
}

// A texel of a picture or map, as a triangle of a draw covers it. `view`: which map.
uint texel_place(ivec2 texel, uint view, uint draw, uint triangle) {
    uint place = hash_combine(uint(texel.x) | (uint(texel.y) << 16), view);
    return hash_combine(hash_combine(place, draw), triangle);
}

// A voxel, as a draw's surface covers it whose dominant axis is `axis`. A column of four voxels along the axis is one place,
// and so are all triangles of the draw: a ray through the surface mostly meets one draw, however finely it is tessellated.
uint voxel_place(ivec3 voxel, int axis, uint draw) {
    ivec3 cell = voxel;
    cell[axis] >>= 2;
    uint place = hash_combine(uint(cell.x) | (uint(cell.y) << 16), uint(cell.z) | (uint(axis) << 16));
    return hash_combine(place, draw);
}

// Whether alpha has a say at all.
bool alpha_matters(Material material) {
    return material.alpha_cutoff != -1.0;
}

bool surface_is_there(Material material, float alpha, uint place) {
    if (!alpha_matters(material)) return true;
    return alpha >= (material.alpha_cutoff >= 0.0 ? mask_threshold(material.alpha_cutoff) : coverage_threshold(place));
}
#endif
