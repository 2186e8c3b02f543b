// Histograms of one light's reflective shadow map, for adaptive partitions: 256 bins of linear view depth (over the
// scene's extent along the view), then 64 of ⟨n·l⟩. Sums are integers: the order of the additions does not matter.
#include "lib/frame.glsl"
#include "surface/rsm_views.glsl"
#include "lrsm/view_extent.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2DArray rsm_radiance;
uniform sampler2DArray rsm_depth;
layout(std430) buffer lrsm_histogram { uint bins[]; };

const int k_depth_bins = 256;
const int k_normal_bins = 64;
shared uint tile[k_depth_bins + k_normal_bins];

void main() {
    for (uint i = gl_LocalInvocationIndex; i < uint(tile.length()); i += 256u)
        tile[i] = 0u;
    barrier();
    ivec3 at = ivec3(gl_GlobalInvocationID);
    ivec3 size = textureSize(rsm_depth, 0);
    if (all(lessThan(at, size))) {
        float depth = texelFetch(rsm_depth, at, 0).r;
        if (depth > 0.0) {
            vec2 extent = view_extent(views[at.z]);
            float z = (shadow_distance(views[at.z], depth) - extent.x) / max(extent.y - extent.x, 1.0e-20);
            float cosine = texelFetch(rsm_radiance, at, 0).a;
            atomicAdd(tile[clamp(int(z * float(k_depth_bins)), 0, k_depth_bins - 1)], 1u);
            atomicAdd(tile[k_depth_bins + clamp(int(cosine * float(k_normal_bins)), 0, k_normal_bins - 1)], 1u);
        }
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < uint(tile.length()); i += 256u)
        if (tile[i] != 0u) atomicAdd(bins[uint(at.z) * uint(tile.length()) + i], tile[i]);
}
