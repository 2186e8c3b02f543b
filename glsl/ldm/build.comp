// The fragments of a batch's maps without a rasterizer: triangles × maps, a work group takes 64 triangles through one map.
// Small triangles are gone through by one invocation each, large ones by the group together.
//
// Coverage is exact and watertight, as a rasterizer's: corners are snapped to 1/256 texel, the signs of the edge functions
// are those of exact integers, and a centre on an edge belongs to the triangle that the top-left rule names. Depths are
// weighted by exact edge functions, so that slivers have no less of them.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "ldm/insert.glsl"
#include "ldm/node.glsl"
// Behind the counters lie the draws' first triangles (a block of their own would be the ninth).
#define DRAW_START(i) ldm_counted[8 + (i)]
#include "lib/draw_of_triangle.glsl"

layout(local_size_x = 64) in;

uniform int batch; // its number
uniform int draw_count;
uniform int bands; // the map's rows are divided among so many groups (some drivers cut loops off after 65,535 steps)

const int k_small = 16;     // texels that one invocation looks at
const int k_unit = 256;     // steps of the snapping in a texel

struct FlatTriangle {
    ivec2 corners[3]; // counterclockwise
    float depths[3];
    uint index; // over all draws
    bool turned; // corners 1 and 2 are swapped
};

shared FlatTriangle large[64];
shared int large_count;

// d × e, whose terms may have 38 bits: as a float, exact but for its rounding.
float cross_of(ivec2 d, ivec2 e) {
    float rough = float(d.x) * float(e.y) - float(d.y) * float(e.x);
    if (abs(rough) < 1.0e9) return float(d.x * e.y - d.y * e.x); // the low 32 bits are all there is
    int high_a, high_b, low_a, low_b;
    imulExtended(d.x, e.y, high_a, low_a);
    imulExtended(d.y, e.x, high_b, low_b);
    uint low = uint(low_a) - uint(low_b);
    int high = high_a - high_b - (uint(low_a) < uint(low_b) ? 1 : 0);
    if (high < 0) { // of a difference so large, the float of its opposite is as exact
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1 : 0);
        return -(float(high) * 4294967296.0 + float(low));
    }
    return float(high) * 4294967296.0 + float(low);
}

// Whether a centre lies on the edge's inner side: `side` is the edge function there.
bool is_inside(float side, ivec2 edge) {
    return side > 0.0 || (side == 0.0 && (edge.y < 0 || (edge.y == 0 && edge.x < 0)));
}

uint index_at(FlatTriangle t, int draw, int corner) {
    int k = t.turned && corner > 0 ? 3 - corner : corner;
    return indices[draws[draw].first_index + 3u * (t.index - DRAW_START(draw)) + uint(k)];
}

FlatTriangle flatten(uint triangle, LdmView view, out float area) {
    FlatTriangle t;
    t.index = triangle;
    t.turned = false;
    int draw = draw_of(triangle, draw_count);
    mat4 world = draws[draw].world;
    for (int i = 0; i < 3; ++i) {
        vec3 p = ldm_project(view, (world * vec4(vertices[index_at(t, draw, i)].position_u.xyz, 1.0)).xyz);
        t.corners[i] = ivec2(round(p.xy * float(k_unit)));
        t.depths[i] = p.z;
    }
    area = cross_of(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    if (area < 0.0) {
        ivec2 corner = t.corners[1];
        t.corners[1] = t.corners[2], t.corners[2] = corner;
        float depth = t.depths[1];
        t.depths[1] = t.depths[2], t.depths[2] = depth;
        t.turned = true;
        area = -area;
    }
    return t;
}

// Texels of the band whose centres lie in the box around the triangle: from xy to zw.
ivec4 texels_of(FlatTriangle t, ivec2 rows) {
    ivec2 low = min(t.corners[0], min(t.corners[1], t.corners[2])), high = max(t.corners[0], max(t.corners[1], t.corners[2]));
    ivec2 from = (low + (k_unit / 2 - 1)) >> 8, to = (high - k_unit / 2) >> 8;
    return ivec4(max(from, ivec2(0, rows.x)), min(to, ivec2(ldm.resolution - 1, rows.y)));
}

void visit(FlatTriangle t, int slot, ivec2 texel) {
    ivec2 centre = texel * k_unit + k_unit / 2;
    ivec2 ab = t.corners[1] - t.corners[0], bc = t.corners[2] - t.corners[1], ca = t.corners[0] - t.corners[2];
    vec3 weight = vec3(cross_of(bc, centre - t.corners[1]), cross_of(ca, centre - t.corners[2]), cross_of(ab, centre - t.corners[0]));
    if (!is_inside(weight.x, bc) || !is_inside(weight.y, ca) || !is_inside(weight.z, ab)) return;
    float area = cross_of(ab, -ca);
    float depth = (weight.x * t.depths[0] + weight.y * t.depths[1] + weight.z * t.depths[2]) / area;
    weight /= area;

    int draw = draw_of(t.index, draw_count);
    Material material = materials[draws[draw].material];
    vec3 albedo = vec3(0.0);
    if (material.alpha_cutoff >= 0.0 || ldm.node_words > 3) {
        Vertex corners[3] = Vertex[3](vertices[index_at(t, draw, 0)], vertices[index_at(t, draw, 1)], vertices[index_at(t, draw, 2)]);
        TrianglePoint point = triangle_point_of(corners, weight, area / float(k_unit * k_unit));
        if (material.alpha_cutoff >= 0.0 && alpha_of(material, point) < material.alpha_cutoff) return;
        if (ldm.node_words > 3) {
            albedo = material.base_colour.rgb * point.colour.rgb * sample_at_point(material.base_colour_texture, point, 16.0).rgb;
            albedo *= 1.0 - material.metallic * sample_at_point(material.metallic_roughness_texture, point, 16.0).b;
        }
    }
    vec2 slope = vec2(0.0);
    if (ldm.node_words > 2) {
        vec2 rise = vec2(t.depths[1] - t.depths[0], t.depths[2] - t.depths[0]);
        slope = vec2(dot(rise, vec2(-ca.y, -ab.y)), dot(rise, vec2(ca.x, ab.x))) * (float(k_unit) / area);
    }
    insert_fragment(uint(ldm_head(slot, texel)), pack_node(depth, slope, albedo));
}

void main() {
    int slot = int(gl_WorkGroupID.y), lane = int(gl_LocalInvocationID.x);
    LdmView view = views[batch + slot * ldm.batches];
    int height = (ldm.resolution + bands - 1) / bands;
    ivec2 rows = int(gl_WorkGroupID.z) * height + ivec2(0, height - 1);
    uint triangles = DRAW_START(draw_count);
    for (uint first = gl_WorkGroupID.x * 64u; first < triangles; first += gl_NumWorkGroups.x * 64u) {
        if (lane == 0) large_count = 0;
        barrier();
        uint triangle = first + uint(lane);
        if (triangle < triangles) {
            float area;
            FlatTriangle t = flatten(triangle, view, area);
            ivec4 box = texels_of(t, rows);
            int width = box.z - box.x + 1, count = width * (box.w - box.y + 1);
            if (area > 0.0 && box.z >= box.x && box.w >= box.y) {
                if (count > k_small) {
                    large[atomicAdd(large_count, 1)] = t;
                } else {
                    for (int i = 0; i < count; ++i)
                        visit(t, slot, box.xy + ivec2(i % width, i / width));
                }
            }
        }
        barrier();
        for (int k = 0; k < large_count; ++k) {
            FlatTriangle t = large[k];
            ivec4 box = texels_of(t, rows);
            int width = box.z - box.x + 1, count = width * (box.w - box.y + 1);
            for (int i = lane; i < count; i += 64)
                visit(t, slot, box.xy + ivec2(i % width, i / width));
        }
        barrier();
    }
}
