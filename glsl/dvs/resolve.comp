// The attributes of each voxel that is new on the list: means of what its fragments left. average: the packed means;
// last_writer: the surface of the one triangle whose number stayed; sum and gather: sums over their count. Into the flag volume go the
// leaves: six bits, one for each way that a surface in the voxel faces.
#include "voxel/scene_triangles.glsl"
#include "dvs/list.glsl"
#include "dvs/fixed_point.glsl"
#include "dvs/triangle_fragment.glsl"

layout(local_size_x = 64) in;

layout(r8ui) writeonly uniform uimage3D voxels_flags;
layout(FORMAT_voxels_albedo) writeonly uniform image3D voxels_albedo;
layout(FORMAT_voxels_normal) writeonly uniform image3D voxels_normal;
layout(FORMAT_voxels_emission) writeonly uniform image3D voxels_emission;  //! optional
layout(r32ui) readonly uniform uimage3D voxels_packed_albedo;              //! optional
layout(r32ui) readonly uniform uimage3D voxels_packed_normal;              //! optional
layout(r32ui) readonly uniform uimage3D voxels_packed_emission;            //! optional
layout(std430) readonly buffer voxels_sums { uint sums[]; };               //! optional

uniform uint kind;
uniform int averaging;
uniform float emission_scale;
uniform bool planes; // the mean plane goes into voxels.normal
uniform float plane_coherence = 0.8; //! [0.3, 1] planes: the length of the averaged normal from which a voxel has a plane

vec3 unpack_mean(uint bits) {
    return vec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / 255.0;
}

void main() {
    uint index = listed_index();
    if (index >= listed || (kind == k_dynamic && index < static_listed)) return;
    ivec3 voxel = voxel_of(list[index]);
    VoxelFragment f;
    f.emission = vec3(0.0);
    if (averaging == averaging_average) {
        f.albedo = unpack_mean(imageLoad(voxels_packed_albedo, voxel).r);
        f.normal = 2.0 * unpack_mean(imageLoad(voxels_packed_normal, voxel).r) - 1.0;
        if (emission_scale > 0.0) f.emission = emission_scale * unpack_mean(imageLoad(voxels_packed_emission, voxel).r);
        f.leaves = 0u;
    } else if (averaging == averaging_last_writer) {
        f = fragment_of(load_triangle(sums[index], draw_starts.length() - 1), voxel);
    } else {
        uint base = index * k_sums;
        float share = 1.0 / (k_fixed * float(max(sums[base], 1u)));
        f.albedo = share * vec3(sums[base + 1u], sums[base + 2u], sums[base + 3u]);
        f.normal = share * vec3(int(sums[base + 4u]), int(sums[base + 5u]), int(sums[base + 6u]));
        if (emission_scale > 0.0) f.emission = emission_scale * share * vec3(sums[base + 7u], sums[base + 8u], sums[base + 9u]);
        f.leaves = sums[base + 10u];
        f.offset = share * float(int(sums[base + 11u]));
        f.area = float(sums[base + 12u]) / k_fixed;
    }
    float size = length(f.normal), offset = 1.0;
    // The mean of the planes' equations is a plane; past that of a corner (normals .71 long) rays would leak.
    if (planes && averaging != averaging_average && size > plane_coherence) offset = clamp(f.offset / size, -0.87, 0.87);
    if (k_emission && emission_share == emission_share_covered && (averaging == averaging_sum || averaging == averaging_gather) && f.emission != vec3(0.0)) {
        // Of a small body in the voxel a quarter of its surface is seen on average, in front of a quarter of the voxel's.
        float shown = size > 0.3 ? plane_area_in_voxel(f.normal / size, clamp(f.offset / size, -0.8, 0.8)) : 6.0;
        f.emission *= float(sums[index * k_sums]) / max(max(shown, f.area), 0.01);
    }
    if (f.leaves == 0u) f.leaves = leaves_of(size > 0.0 ? f.normal / size : vec3(0.0), size < 0.1);
    if (f.leaves == 0u) f.leaves = 63u;
    imageStore(voxels_albedo, voxel, vec4(f.albedo, 1.0));
    imageStore(voxels_normal, voxel, vec4(f.normal, offset));
    if (emission_scale > 0.0) imageStore(voxels_emission, voxel, vec4(f.emission, 1.0));
    imageStore(voxels_flags, voxel, uvec4(kind | (f.leaves << 2)));
}
