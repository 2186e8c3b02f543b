#ifndef DVS_FRAGMENT_STORE_GLSL
#define DVS_FRAGMENT_STORE_GLSL
// What a fragment (a triangle's piece inside a voxel) writes into its voxel (DVS, section V). mark: the triangle's number,
// whoever comes last; add: integer sums, whose order does not matter; average: the published running mean, packed into
// 32 bits and replaced by compare-and-swap (Crassin & Green 2012), whose order does.
layout(r32ui) uniform uimage3D voxels_place;           //! ordered: an operation either writes or reads
layout(r8ui) readonly uniform uimage3D voxels_flags;
layout(r8ui) writeonly uniform uimage3D voxels_bricks; // of 4³ voxels: which were written
layout(r32ui) uniform uimage3D voxels_packed_albedo;   //! optional
layout(r32ui) uniform uimage3D voxels_packed_normal;   //! optional
layout(r32ui) uniform uimage3D voxels_packed_emission; //! optional
layout(std430) buffer voxels_sums { uint sums[]; };    //! optional

uniform uint kind;     // of the geometry: 1 static, 2 dynamic
const int k_mark = 0, k_add = 1, k_average = 2; // as in passes/dvs/voxelization.cpp
uniform int operation;
uniform float emission_scale; // the brightest emission in the scene

#include "dvs/fixed_point.glsl"
#include "dvs/running_average.glsl"

// Dynamic geometry leaves static voxels as they are.
bool taken_by_static(ivec3 voxel) {
    return kind == 2u && (imageLoad(voxels_flags, voxel).r & 1u) != 0u;
}

void store_mark(ivec3 voxel, uint triangle) {
    imageStore(voxels_place, voxel, uvec4(triangle + 1u));
    imageStore(voxels_bricks, voxel >> 2, uvec4(1u));
}

void store_fragment(ivec3 voxel, VoxelFragment f) {
    if (operation == k_average) {
        imageStore(voxels_place, voxel, uvec4(1u));
        imageStore(voxels_bricks, voxel >> 2, uvec4(1u));
        running_average_albedo(voxel, f.albedo);
        running_average_normal(voxel, 0.5 * f.normal + 0.5);
        if (emission_scale > 0.0) running_average_emission(voxel, f.emission / emission_scale);
        return;
    }
    uint place = imageLoad(voxels_place, voxel).r;
    if (place == 0u) return; // the list was full
    uint base = (place - 1u) * k_sums;
    uvec3 albedo = fixed_share(f.albedo), normal = fixed_normal(f.normal);
    uvec3 emission = emission_scale > 0.0 ? fixed_emission(f.emission / emission_scale, emission_weight(f)) : uvec3(0u);
    atomicAdd(sums[base], 1u);
    for (uint i = 0u; i < 3u; ++i) {
        atomicAdd(sums[base + 1u + i], albedo[i]);
        atomicAdd(sums[base + 4u + i], normal[i]);
        if (emission_scale > 0.0) atomicAdd(sums[base + 7u + i], emission[i]);
    }
    atomicOr(sums[base + 10u], f.leaves);
    atomicAdd(sums[base + 11u], fixed_offset(f.offset));
    if (f.area > 0.0) atomicAdd(sums[base + 12u], fixed_area(f.area));
}

#endif
