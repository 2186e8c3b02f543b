// Imperfect shadow maps (Ritschel et al. 2008, section 4): each virtual point light has a paraboloid map of the hemisphere about
// its normal, into which its own random subset of the scene's points is splatted. One invocation a point of a light. A texel
// keeps the nearest: the largest of the bits of 1/distance; 0 where nothing was splatted.
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "lib/coverage.glsl"
#include "ism/vpl.glsl"
#include "vf/grid.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer ism_vpls { Vpl vpls[]; };
layout(std430) readonly buffer vf_grid { Grid grid; };
layout(std430) readonly buffer vf_proxies { Proxy proxies[]; };
layout(FORMAT_ism_atlas) uniform uimage2D ism_atlas;

uniform int map_side = 64;           //! [8, 512] (texels) width and height of a map
uniform int points = 8000;           //! [16, 65536] per map
uniform float point_scale = 1.0;     //! [0.1, 16] a point's area as a multiple of the area that it stands for in its map
uniform bool plane_depth = false;    //! a splat has the depth of its disc's plane, at most a radius off; off: of its centre
uniform int widest = 16;             //! [1, 64] (texels) a splat is never wider

void main() {
    int v = int(gl_GlobalInvocationID.y);
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(points) || v >= vpls.length()) return;
    Vpl vpl = vpls[v];
    if (vpl.area <= 0.0) return;
    uint pool = grid.entries;
    // One of each stretch of the pool: a stratified subset of its own.
    float chance = float(hash_u32(i * 0x9e3779b1u ^ hash_u32(uint(v) + 1u)) >> 8) / 16777216.0;
    uint place = min(uint((float(i) + chance) * float(pool) / float(points)), pool - 1u);
    Proxy point = proxies[place];
    if (point.area <= 0.0) return;
    float radius = sqrt(point_scale * point.area * max(float(pool) / float(points), 1.0) / 3.14159265359);
    mat3 into_frame = transpose(vpl_frame(vpl.normal));
    vec3 to = into_frame * (point.position - vpl.position), n = into_frame * point.normal;
    float away = length(to);
    // What does not rise above the light's own plane hides nothing. Points of that plane lie all around the horizon.
    float rise = to.z + (plane_depth ? radius * sqrt(max(1.0 - n.z * n.z, 0.0)) : 0.0);
    if (rise <= 1.0e-3 * radius || away <= 1.0e-6 * scene_diagonal) return;
    vec3 d = to / away;
    vec2 centre = (to_paraboloid(vec3(d.xy, max(d.z, -0.5))) * 0.5 + 0.5) * float(map_side);
    // tan(θ/2) changes by 1/(1 + cosθ) per radian.
    float size = clamp(0.5 * float(map_side) * radius / away / (1.0 + max(d.z, 0.0)), 0.5, 0.5 * float(widest));
    int across = imageSize(ism_atlas).x / map_side;
    ivec2 corner = map_corner(v, map_side, across);
    ivec2 low = ivec2(floor(centre - size + 0.5)), high = ivec2(floor(centre + size - 0.5));
    high = max(high, low);
    if (size <= 0.5) low = high = ivec2(floor(centre));
    for (int y = max(low.y, 0); y <= min(high.y, map_side - 1); ++y)
        for (int x = max(low.x, 0); x <= min(high.x, map_side - 1); ++x) {
            vec2 p = (vec2(x, y) + 0.5) / float(map_side) * 2.0 - 1.0;
            if (dot(p, p) > 1.0) continue;
            vec3 ray = from_paraboloid(p);
            float depth = away;
            if (plane_depth) {
                float along = dot(n, ray);
                depth = clamp(dot(n, to) / (abs(along) > 1.0e-4 ? along : 1.0e-4), away - radius, away + radius);
                depth = max(depth, 0.0);
            }
            if (depth > 1.0e-6 * scene_diagonal) imageAtomicMax(ism_atlas, corner + ivec2(x, y), floatBitsToUint(1.0 / depth));
        }
}
