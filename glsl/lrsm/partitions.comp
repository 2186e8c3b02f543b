// The partitions of each light's reflective shadow map (LRSM, section 4.3). uniform: equal parts of the scene's extent, as
// published. adaptive: boundaries where a cut lowers the variance of depth within the layers the most (Otsu's criterion,
// one cut after the other, from the histogram); cuts that gain less than `worthwhile` of the whole variance are not made,
// so a flat scene gets one layer. One invocation a light.
#include "lib/frame.glsl"
#include "surface/rsm_views.glsl"
#include "lrsm/partition.glsl"
#include "lrsm/view_extent.glsl"

layout(local_size_x = 1) in;

layout(std430) readonly buffer lrsm_histogram { uint bins[]; };  //! optional
layout(std430) writeonly buffer lrsm_partitions { Partition partitions[]; };

uniform int depth_layers;
uniform int normal_layers;
uniform bool adaptive;
uniform float overlap = 0.05;     //! [0, 0.5] δ as a share of the mean layer's depth
uniform float worthwhile = 0.02;  //! [0, 1] adaptive: the share of the variance of depth that a further cut must remove

const int k_depth_bins = 256;
const int k_normal_bins = 64;

// Σ n, Σ n·x, Σ n·x² over bins [from, to).
vec3 moments(int base, int from, int to) {
    vec3 sum = vec3(0.0);
    for (int i = from; i < to; ++i) {
        float n = float(bins[base + i]), x = float(i) + 0.5;
        sum += n * vec3(1.0, x, x * x);
    }
    return sum;
}
float spread(vec3 m) {
    return m.x > 0.0 ? max(m.z - m.y * m.y / m.x, 0.0) : 0.0;
}

// The best cut of [from, to): gain in x, bin in y.
vec2 best_cut(int base, int from, int to) {
    vec3 all = moments(base, from, to), left = vec3(0.0);
    vec2 best = vec2(0.0, float(from));
    float first = 0.0; // a gap of empty bins gains the same all along: its middle is taken
    for (int i = from; i + 1 < to; ++i) {
        float n = float(bins[base + i]), x = float(i) + 0.5;
        left += n * vec3(1.0, x, x * x);
        float gain = spread(all) - spread(left) - spread(all - left);
        if (gain > best.x * 1.00001 + 1.0e-9) {
            best = vec2(gain, float(i + 1));
            first = best.y;
        } else if (bins[base + i] == 0u && float(i) + 1.0 > best.y && moments(base, int(first), i + 1).x == 0.0) {
            best.y = 0.5 * (first + float(i + 1));
        }
    }
    return best;
}

void main() {
    int view = int(gl_GlobalInvocationID.x);
    if (view >= views.length()) return;
    vec2 extent = view_extent(views[view]);
    Partition p;
    p.depth_layers = depth_layers;
    for (int i = 0; i < 9; ++i)
        p.depth[i] = mix(extent.x, extent.y, min(float(i) / float(depth_layers), 1.0));
    for (int i = 0; i < 5; ++i)
        p.normal[i] = min(float(i) / float(normal_layers), 1.0);
    if (adaptive) {
        int base = view * (k_depth_bins + k_normal_bins);
        float cuts[9];
        cuts[0] = 0.0;
        int count = 1;
        float whole = spread(moments(base, 0, k_depth_bins));
        float end = float(k_depth_bins);
        while (count < depth_layers) {
            vec2 best = vec2(0.0);
            for (int i = 0; i < count; ++i) {
                float to = i + 1 < count ? cuts[i + 1] : end;
                vec2 cut = best_cut(base, int(ceil(cuts[i])), int(floor(to)));
                if (cut.x > best.x) best = cut;
            }
            if (best.x <= worthwhile * whole || whole <= 0.0) break;
            int at = count++;
            for (; at > 0 && cuts[at - 1] > best.y; --at)
                cuts[at] = cuts[at - 1];
            cuts[at] = best.y;
        }
        p.depth_layers = count;
        for (int i = 0; i < 9; ++i)
            p.depth[i] = i < count ? mix(extent.x, extent.y, cuts[i] / end) : extent.y;
        // ⟨n·l⟩: parts of equal mass.
        float mass = 0.0, total = 0.0;
        for (int i = 0; i < k_normal_bins; ++i)
            total += float(bins[base + k_depth_bins + i]);
        int next = 1;
        for (int i = 0; i < k_normal_bins && next < normal_layers && total > 0.0; ++i) {
            mass += float(bins[base + k_depth_bins + i]);
            while (next < normal_layers && mass >= total * float(next) / float(normal_layers))
                p.normal[next++] = float(i + 1) / float(k_normal_bins);
        }
    }
    p.overlap = overlap * (extent.y - extent.x) / float(p.depth_layers);
    // Layers overlap with their neighbours only.
    for (int i = 0; i < p.depth_layers; ++i)
        p.overlap = min(p.overlap, max(p.depth[i + 1] - p.depth[i], 0.0));
    partitions[view] = p;
}
