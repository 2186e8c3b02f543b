#ifndef LRSM_PARTITION_GLSL
#define LRSM_PARTITION_GLSL
// How one light's reflective shadow map is cut into layers (LRSM, section 4.3): a partitions of linear view depth and b of
// ⟨n·l⟩ give (a + 1)(b + 1) layers. Neighbours in depth overlap by δ; the scene's near and far ends do not fade.
// Depths are metres along the view.

const int k_max_depth_layers = 8;
const int k_max_normal_layers = 4;

// 64 bytes in std430; passes/lrsm/partition.h mirrors it.
struct Partition {
    float depth[9];  // boundaries: depth[i] … depth[i + 1] is depth layer i
    float normal[5]; // boundaries of ⟨n·l⟩, 0 … 1
    float overlap;   // δ, metres
    int depth_layers; // that are used; at most what is allocated
};

// Layers are numbered alike for all lights: place in the table of depth layer d and normal layer n of a view.
int table_index(int view, int d, int n) {
    return (view * k_max_depth_layers + d) * k_max_normal_layers + n;
}

// The range [zMin, zMax] of depth layer i, overlap included.
vec2 layer_range(Partition p, int i) {
    float below = i > 0 ? 0.5 * p.overlap : 0.0;
    float above = i + 1 < p.depth_layers ? 0.5 * p.overlap : 0.0;
    return vec2(p.depth[i] - below, p.depth[i + 1] + above);
}

// Whether a texel at z belongs to depth layer i. The scene's ends are open: a rounded depth just outside still belongs to the
// first or last layer.
bool in_depth_layer(Partition p, int i, float z) {
    vec2 range = layer_range(p, i);
    return i < p.depth_layers && (z >= range.x || i == 0) && (z <= range.y || i == p.depth_layers - 1);
}

// z in [zMin, zMax] → [0, 1] (layered variance shadow maps, Lauritzen & McCool 2008).
float warp_depth(vec2 range, float z) {
    return clamp((z - range.x) / max(range.y - range.x, 1.0e-20), 0.0, 1.0);
}

int normal_layer(Partition p, int normal_layers, float cosine) {
    int layer = 0;
    while (layer + 1 < normal_layers && cosine >= p.normal[layer + 1])
        ++layer;
    return layer;
}

// Eq. 15, at interior boundaries only: k(s) + k(1 − s) = 1 (smoothstep), so that two overlapping layers sum to one.
float layer_decay(Partition p, int i, float z) {
    vec2 range = layer_range(p, i);
    float f = 1.0;
    if (i > 0) f *= smoothstep(0.0, 1.0, (z - range.x) / max(p.overlap, 1.0e-20));
    if (i + 1 < p.depth_layers) f *= smoothstep(0.0, 1.0, (range.y - z) / max(p.overlap, 1.0e-20));
    return f;
}

#endif
