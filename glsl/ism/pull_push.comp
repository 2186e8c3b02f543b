// Holes of the imperfect shadow maps are filled by pull and push (Ritschel et al. 2008, section 4.2): a pyramid of means over
// the texels that hold something, from which holes are filled from coarse to fine. A mean leaves out what lies further behind
// than a limit that grows by level; with `outliers`, so do texels that differ too much from the level above. One group a map.
#include "ism/vpl.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 256) in;

layout(std430) readonly buffer ism_vpls { Vpl vpls[]; };
layout(FORMAT_ism_atlas) uniform uimage2D ism_atlas; //! ordered: others are read before a barrier and none is written before it

uniform int map_side = 64;           //! [8, 512] (texels) width and height of a map
uniform int levels = 3;              //! [0, 3] of the pyramid
uniform float depth_limit = 0.02;    //! [0, 1] by how much depths that are averaged may differ, share of the diagonal; doubled per level
uniform bool outliers = true;        //! texels that differ from the level above by more than the limit take its depth, as published

const int k_half = 32 * 32, k_quarter = 16 * 16, k_eighth = 8 * 8;
shared float pyramid[k_half + k_quarter + k_eighth]; // distance; 0: hole

int side_of(int level) {
    return map_side >> level;
}
int start_of(int level) {
    return level == 1 ? 0 : (level == 2 ? k_half : k_half + k_quarter);
}
ivec2 corner;

float depth_at(ivec2 at, int level) {
    if (level > 0) return pyramid[start_of(level) + at.y * side_of(level) + at.x];
    uint bits = imageLoad(ism_atlas, corner + at).r;
    return bits == 0u ? 0.0 : 1.0 / uintBitsToFloat(bits);
}

float mean_of_four(ivec2 at, int level) {
    float four[4], nearest = 3.0e38, sum = 0.0, count = 0.0;
    for (int k = 0; k < 4; ++k) {
        four[k] = depth_at(2 * at + ivec2(k & 1, k >> 1), level);
        if (four[k] > 0.0) nearest = min(nearest, four[k]);
    }
    float limit = depth_limit * scene_diagonal * float(1 << level);
    for (int k = 0; k < 4; ++k) {
        if (four[k] <= 0.0 || four[k] > nearest + limit) continue;
        sum += four[k];
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// Bilinear between the coarser texels that hold something.
float from_coarser(ivec2 at, int level) {
    vec2 place = (vec2(at) + 0.5) * 0.5 - 0.5;
    ivec2 low = ivec2(floor(place));
    vec2 share = place - vec2(low);
    float sum = 0.0, weight = 0.0;
    for (int k = 0; k < 4; ++k) {
        ivec2 c = ivec2(k & 1, k >> 1);
        float there = depth_at(clamp(low + c, ivec2(0), ivec2(side_of(level) - 1)), level);
        vec2 bilinear = mix(1.0 - share, share, vec2(c));
        if (there <= 0.0) continue;
        sum += bilinear.x * bilinear.y * there;
        weight += bilinear.x * bilinear.y;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

void main() {
    int lane = int(gl_LocalInvocationIndex), v = int(gl_WorkGroupID.x);
    corner = map_corner(v, map_side, imageSize(ism_atlas).x / map_side);
    for (int level = 1; level <= levels; ++level) {
        int side = side_of(level);
        for (int i = lane; i < side * side; i += 256)
            pyramid[start_of(level) + i] = mean_of_four(ivec2(i % side, i / side), level - 1);
        barrier();
    }
    for (int level = levels - 1; level >= 0; --level) {
        int side = side_of(level);
        float limit = depth_limit * scene_diagonal * float(1 << level);
        for (int i = lane; i < side * side; i += 256) {
            ivec2 at = ivec2(i % side, i / side);
            float own = depth_at(at, level), above = from_coarser(at, level + 1);
            if (above <= 0.0 || (own > 0.0 && (!outliers || abs(own - above) <= limit))) continue;
            if (level > 0) pyramid[start_of(level) + i] = above;
            else imageStore(ism_atlas, corner + at, uvec4(floatBitsToUint(1.0 / above)));
        }
        barrier();
    }
}
