#ifndef DVS_FRAGMENT_STORE_GLSL
#define DVS_FRAGMENT_STORE_GLSL
// What a fragment (a triangle's piece inside a voxel) writes into its voxel (DVS, section V). mark: the triangle's number,
// whoever comes last; link: its number in the voxel's own list, whose order does not matter either, since what is read from
// it are integer sums; add: integer sums, whose order does not matter; average: the published running mean, packed into
// 32 bits and replaced by compare-and-swap (Crassin & Green 2012), whose order does.
layout(r32ui) uniform uimage3D voxels_place;
layout(r8ui) readonly uniform uimage3D voxels_flags;
layout(std430) buffer voxels_links { uvec2 links[]; };          //! optional
layout(r32ui) uniform uimage3D voxels_packed_albedo;   //! optional
layout(r32ui) uniform uimage3D voxels_packed_normal;   //! optional
layout(r32ui) uniform uimage3D voxels_packed_emission; //! optional
layout(std430) buffer voxels_sums { uint sums[]; };            //! optional
layout(std430) buffer voxels_plane_sums { uint plane_sums[]; }; //! optional

uniform uint kind;     // of the geometry: 1 static, 2 dynamic
uniform int operation; // 0 mark, 1 add, 2 average, 3 link
uniform float emission_scale; // the brightest emission in the scene
uniform bool plane_sums_kept; // voxels.plane_sums is there

const uint k_sums = 12u; // a voxel: fragments, albedo, normal, emission, leaves, spare
const uint k_planes = 2u; // a voxel: the plane's offset, the area of what emits
const float k_fixed = 32767.0;

#include "dvs/list.glsl"
#include "dvs/running_average.glsl"

// Dynamic geometry leaves static voxels as they are.
bool taken_by_static(ivec3 voxel) {
    return kind == 2u && (imageLoad(voxels_flags, voxel).r & 1u) != 0u;
}

void store_mark(ivec3 voxel, uint triangle) {
    imageStore(voxels_place, voxel, uvec4(triangle + 1u));
}

// A link: a triangle, and the link before it, plus one. `sums` holds each list's head, plus one.
void store_link(ivec3 voxel, uint triangle) {
    uint place = imageLoad(voxels_place, voxel).r;
    if (place == 0u) return; // the list of voxels had no room
    uint link = atomicAdd(linked, 1u);
    if (link >= uint(links.length())) return;
    links[link] = uvec2(triangle, atomicExchange(sums[place - 1u], link + 1u));
}

void store_fragment(ivec3 voxel, VoxelFragment f) {
    if (operation == 2) {
        imageStore(voxels_place, voxel, uvec4(1u));
        running_average_albedo(voxel, f.albedo);
        running_average_normal(voxel, 0.5 * f.normal + 0.5);
        if (emission_scale > 0.0) running_average_emission(voxel, f.emission / emission_scale);
        return;
    }
    uint place = imageLoad(voxels_place, voxel).r;
    if (place == 0u) return; // the list had no room
    uint base = (place - 1u) * k_sums;
    atomicAdd(sums[base], 1u);
    float emission_weight = k_fixed * (emission_share == 1 ? f.area : 1.0);
    for (uint i = 0u; i < 3u; ++i) {
        atomicAdd(sums[base + 1u + i], uint(round(clamp(f.albedo[i], 0.0, 1.0) * k_fixed)));
        atomicAdd(sums[base + 4u + i], uint(int(round(clamp(f.normal[i], -1.0, 1.0) * k_fixed))));
        if (emission_scale > 0.0)
            atomicAdd(sums[base + 7u + i], uint(round(clamp(f.emission[i] / emission_scale, 0.0, 1.0) * emission_weight)));
    }
    atomicOr(sums[base + 10u], f.leaves);
    if (!plane_sums_kept) return;
    base = (place - 1u) * k_planes;
    atomicAdd(plane_sums[base], uint(int(round(clamp(f.offset, -1.0, 1.0) * k_fixed))));
    if (f.area > 0.0) atomicAdd(plane_sums[base + 1u], uint(round(f.area * k_fixed)));
}

#endif
