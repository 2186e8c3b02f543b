// The fragments of a batch's maps without a rasterizer: triangles × maps, in two rounds without barriers. First an invocation
// takes a triangle through up to 16 maps; where it is too large for that, it is marked. Then a work group takes each marked
// one.
//
// Coverage is exact and watertight, as a rasterizer's: corners are snapped to 1/256 texel, the signs of the edge functions
// are those of exact integers, and a centre on an edge belongs to the triangle that the top-left rule names. Depths are
// weighted by exact edge functions, so that slivers have no less of them.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"
#include "ldm/insert.glsl"
#include "ldm/node.glsl"
// Behind the counters lie the draws' first triangles, and the marks (blocks of their own would be too many).
#define DRAW_START(i) ldm_counted[8 + (i)]
#include "lib/draw_of_triangle.glsl"

layout(local_size_x = 64) in;

uniform int batch; // its number
uniform int draw_count;
uniform int slot_count;
uniform int bands; // 0: the first round; else the second, and among how many groups a map's rows are divided (some drivers
                   // silently end an invocation's loops after 65,535 steps)

const int k_small = 64; // texels that one invocation looks at
const int k_unit = 256; // steps of the snapping in a texel
const float k_far_off = 4.0e6; // texels: corners beyond (of strays) leave the range of snapped ones

struct FlatTriangle {
    ivec2 corners[3]; // counterclockwise
    float depths[3];
    int draw;
    uint first;  // of its indices
    bool turned; // corners 1 and 2 are swapped
};

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

// Whether a centre lies on an edge's inner side: the sign of `edge` × `to_centre`, by the low 32 bits where those are all.
bool is_inside(ivec2 edge, ivec2 to_centre) {
    float rough = float(edge.x) * float(to_centre.y) - float(edge.y) * float(to_centre.x);
    int low = edge.x * to_centre.y - edge.y * to_centre.x;
    if (abs(rough) > 1.0e8) return rough > 0.0;
    return low > 0 || (low == 0 && (edge.y < 0 || (edge.y == 0 && edge.x < 0)));
}

bool covers(FlatTriangle t, ivec2 centre) {
    return is_inside(t.corners[1] - t.corners[0], centre - t.corners[0]) && is_inside(t.corners[2] - t.corners[1], centre - t.corners[1]) &&
           is_inside(t.corners[0] - t.corners[2], centre - t.corners[2]);
}

uint index_at(FlatTriangle t, int corner) {
    return indices[t.first + uint(t.turned && corner > 0 ? 3 - corner : corner)];
}

FlatTriangle load_triangle(uint triangle, out vec3 positions[3]) {
    FlatTriangle t;
    t.draw = draw_of(triangle, draw_count);
    t.first = draws[t.draw].first_index + 3u * (triangle - DRAW_START(t.draw));
    t.turned = false;
    mat4 world = draws[t.draw].world;
    for (int i = 0; i < 3; ++i)
        positions[i] = (world * vec4(vertices[indices[t.first + uint(i)]].position_u.xyz, 1.0)).xyz;
    return t;
}

// False without an area, or where the triangle cannot be snapped.
bool flatten(inout FlatTriangle t, vec3 positions[3], LdmView view) {
    for (int i = 0; i < 3; ++i) {
        vec3 p = ldm_project(view, positions[i]);
        if (!(max(abs(p.x), abs(p.y)) < k_far_off)) return false;
        t.corners[i] = ivec2(round(p.xy * float(k_unit)));
        t.depths[i] = p.z;
    }
    float area = cross_of(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    t.turned = area < 0.0;
    if (t.turned) {
        ivec2 corner = t.corners[1];
        t.corners[1] = t.corners[2], t.corners[2] = corner;
        float depth = t.depths[1];
        t.depths[1] = t.depths[2], t.depths[2] = depth;
    }
    return area != 0.0;
}

// Texels of the band whose centres lie in the box around the triangle: from xy to zw.
ivec4 texels_of(FlatTriangle t, ivec2 rows) {
    ivec2 low = min(t.corners[0], min(t.corners[1], t.corners[2])), high = max(t.corners[0], max(t.corners[1], t.corners[2]));
    ivec2 from = (low + (k_unit / 2 - 1)) >> 8, to = (high - k_unit / 2) >> 8;
    return ivec4(max(from, ivec2(0, rows.x)), min(to, ivec2(ldm.resolution - 1, rows.y)));
}

// The fragment of a covered texel.
void insert_texel(FlatTriangle t, int slot, ivec2 texel) {
    ivec2 centre = texel * k_unit + k_unit / 2;
    ivec2 ab = t.corners[1] - t.corners[0], bc = t.corners[2] - t.corners[1], ca = t.corners[0] - t.corners[2];
    vec3 weight = vec3(cross_of(bc, centre - t.corners[1]), cross_of(ca, centre - t.corners[2]), cross_of(ab, centre - t.corners[0]));
    float area = cross_of(ab, -ca);
    float depth = (weight.x * t.depths[0] + weight.y * t.depths[1] + weight.z * t.depths[2]) / area;
    if (!(depth >= 0.0 && depth <= 1.0)) return; // before or behind the view's box lies what strays
    weight /= area;

    Material material = materials[draws[t.draw].material];
    vec3 albedo = vec3(0.0);
    bool passes = true;
    // A loop and not a branch: some software drivers go through all lookups of a branch that no invocation takes.
    for (bool looks_up = alpha_matters(material) || ldm.node_words > 3; looks_up; looks_up = false) {
        Vertex corners[3] = Vertex[3](vertices[index_at(t, 0)], vertices[index_at(t, 1)], vertices[index_at(t, 2)]);
        TrianglePoint point = triangle_point_of(corners, weight, area / float(k_unit * k_unit));
        uint place = texel_place(texel, uint(batch + slot * ldm.batches), uint(t.draw), (t.first - draws[t.draw].first_index) / 3u);
        passes = !alpha_matters(material) || surface_is_there(material, alpha_of(material, point), place);
        for (bool coloured = ldm.node_words > 3; coloured; coloured = false) {
            albedo = material.base_colour.rgb * point.colour.rgb * sample_at_point(material.base_colour_texture, point, 16.0).rgb;
            albedo *= 1.0 - material.metallic * sample_at_point(material.metallic_roughness_texture, point, 16.0).b;
        }
    }
    if (!passes) return;
    vec2 rise = vec2(t.depths[1] - t.depths[0], t.depths[2] - t.depths[0]);
    vec2 slope = vec2(dot(rise, vec2(-ca.y, -ab.y)), dot(rise, vec2(ca.x, ab.x))) * (float(k_unit) / area);
    insert_fragment(uint(ldm_head(slot, texel)), pack_node(depth, slope, albedo));
}

// Every `step`-th of the box's `count` texels, from the `first`. Each invocation looks for its next covered one before all insert.
void go_through(FlatTriangle t, int slot, ivec4 box, int first, int count, int step) {
    int width = max(box.z - box.x + 1, 1);
    for (int i = first; i < count; i += step) {
        ivec2 texel = box.xy + ivec2(i % width, i / width);
        while (i < count && !covers(t, texel * k_unit + k_unit / 2)) {
            i += step;
            texel = box.xy + ivec2(i % width, i / width);
        }
        if (i < count) insert_texel(t, slot, texel);
    }
}

int texel_count(ivec4 box) {
    ivec2 size = max(box.zw - box.xy + 1, ivec2(0));
    return size.x * size.y;
}

const int k_maps_each = 16;

int marks_of(uint group, int slot) {
    return 8 + draw_count + 1 + 2 * (int(group) * slot_count + slot);
}

// The first round. A triangle's corners are loaded once for all its maps.
void take_small(uint triangle) {
    vec3 positions[3];
    FlatTriangle t = load_triangle(triangle, positions);
    int from = int(gl_WorkGroupID.y) * k_maps_each, to = min(from + k_maps_each, batch_maps(batch));
    for (int slot = from; slot < to; ++slot) {
        if (!flatten(t, positions, views[batch + slot * ldm.batches])) continue;
        ivec4 box = texels_of(t, ivec2(0, ldm.resolution - 1));
        int count = texel_count(box);
        if (count > k_small) atomicOr(ldm_counted[marks_of(triangle / 64u, slot) + int(triangle / 32u & 1u)], 1u << (triangle & 31u));
        else go_through(t, slot, box, 0, count, 1);
    }
}

// The second round, for one map: the marked ones among 64 triangles.
void take_marked(uint group, int slot, ivec2 rows) {
    LdmView view = views[batch + slot * ldm.batches];
    for (int word = 0; word < 2; ++word) {
        for (uint bits = ldm_counted[marks_of(group, slot) + word]; bits != 0u; bits &= bits - 1u) {
            vec3 positions[3];
            FlatTriangle t = load_triangle(64u * group + uint(32 * word + findLSB(bits)), positions);
            flatten(t, positions, view);
            ivec4 box = texels_of(t, rows);
            go_through(t, slot, box, int(gl_LocalInvocationID.x), texel_count(box), 64);
        }
    }
}

void main() {
    uint triangles = DRAW_START(draw_count);
    int height = (ldm.resolution + max(bands, 1) - 1) / max(bands, 1), band = int(gl_WorkGroupID.z);
    ivec2 rows = ivec2(band * height, min((band + 1) * height, ldm.resolution) - 1);
    for (uint group = gl_WorkGroupID.x; 64u * group < triangles; group += gl_NumWorkGroups.x) {
        uint triangle = 64u * group + gl_LocalInvocationID.x;
        if (bands > 0) take_marked(group, int(gl_WorkGroupID.y), rows);
        else if (triangle < triangles) take_small(triangle);
    }
}
