#pragma once
// How one light's reflective shadow map is cut into layers (LRSM, section 4.3). glsl/lrsm/partition.glsl mirrors it.

namespace bounce {

inline constexpr int k_max_depth_layers = 8;
inline constexpr int k_max_normal_layers = 4;

/// std430. Depths are metres along the light's view.
struct LrsmPartition {
    float depth[k_max_depth_layers + 1];   ///< boundaries: depth[i] … depth[i + 1] is depth layer i
    float normal[k_max_normal_layers + 1]; ///< boundaries of ⟨n·l⟩, 0 … 1
    float overlap;                         ///< δ, metres
    int depth_layers;                      ///< that are used; at most what is allocated
};
static_assert(sizeof(LrsmPartition) == 64);

} // namespace bounce
