// The attributes of each voxel that is new on the list: means of what its fragments left. average: the packed means;
// last_writer: the surface of the one triangle whose number stayed; sum: sums over their count; gather: the same sums,
// which the voxel makes itself from the list of its triangles. Into the flag volume go the
// leaves: six bits, one for each way that a surface in the voxel faces.
#include "voxel/triangle_voxels.glsl"
#include "dvs/list.glsl"
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
layout(std430) readonly buffer voxels_links { uvec2 links[]; };            //! optional
layout(std430) readonly buffer voxels_plane_sums { uint plane_sums[]; };   //! optional

uniform uint kind;
uniform int averaging;
uniform float emission_scale;
uniform bool plane_sums_kept; // voxels.plane_sums is there
uniform bool planes;          // the mean plane goes into voxels.normal
uniform float plane_coherence = 0.3; //! [0.3, 1] planes: the length of the averaged normal from which a voxel has a plane

void visit_voxel(VisitedTriangle triangle, ivec3 voxel) {}

// Integer sums, as in dvs/fragment_store.glsl: to the bit the same as those of averaging=sum.
struct Sums {
    uint count;
    uvec3 albedo, emission;
    ivec3 normal;
    uint leaves;
    int offset;
    uint area;
};
const float k_fixed = 32767.0;

Sums gathered_sums(uint head, ivec3 voxel) {
    Sums s = Sums(0u, uvec3(0u), uvec3(0u), ivec3(0), 0u, 0, 0u);
    int draw_count = draw_starts.length() - 1;
    while (head != 0u) {
        uvec2 link = links[head - 1u];
        head = link.y;
        VoxelFragment f = fragment_of(load_triangle(link.x, draw_count), voxel);
        float emission_weight = k_fixed * (emission_share == 1 ? f.area : 1.0);
        s.count += 1u;
        s.albedo += uvec3(round(clamp(f.albedo, vec3(0.0), vec3(1.0)) * k_fixed));
        s.normal += ivec3(round(clamp(f.normal, vec3(-1.0), vec3(1.0)) * k_fixed));
        if (emission_scale > 0.0) s.emission += uvec3(round(clamp(f.emission / emission_scale, vec3(0.0), vec3(1.0)) * emission_weight));
        s.leaves |= f.leaves;
        s.offset += int(round(clamp(f.offset, -1.0, 1.0) * k_fixed));
        s.area += uint(round(f.area * k_fixed));
    }
    return s;
}

Sums stored_sums(uint index) {
    uint base = index * 12u;
    Sums s;
    s.count = sums[base];
    s.albedo = uvec3(sums[base + 1u], sums[base + 2u], sums[base + 3u]);
    s.normal = ivec3(sums[base + 4u], sums[base + 5u], sums[base + 6u]);
    s.emission = uvec3(sums[base + 7u], sums[base + 8u], sums[base + 9u]);
    s.leaves = sums[base + 10u];
    s.offset = 0;
    s.area = 0u;
    if (plane_sums_kept) s.offset = int(plane_sums[2u * index]), s.area = plane_sums[2u * index + 1u];
    return s;
}

vec3 unpack_mean(uint bits) {
    return vec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / 255.0;
}

void main() {
    uint index = listed_index();
    if (index >= listed || (kind == k_dynamic && index < static_listed)) return;
    ivec3 voxel = voxel_of(list[index]);
    VoxelFragment f;
    f.emission = vec3(0.0);
    float count = 1.0;
    if (averaging == 0) {
        f.albedo = unpack_mean(imageLoad(voxels_packed_albedo, voxel).r);
        f.normal = 2.0 * unpack_mean(imageLoad(voxels_packed_normal, voxel).r) - 1.0;
        if (emission_scale > 0.0) f.emission = emission_scale * unpack_mean(imageLoad(voxels_packed_emission, voxel).r);
        f.leaves = 0u;
    } else if (averaging == 1) {
        f = fragment_of(load_triangle(sums[index], draw_starts.length() - 1), voxel);
    } else {
        Sums all;
        if (averaging == 2) all = stored_sums(index);
        else all = gathered_sums(sums[index], voxel);
        float share = 1.0 / (k_fixed * float(max(all.count, 1u)));
        f.albedo = share * vec3(all.albedo);
        f.normal = share * vec3(all.normal);
        if (emission_scale > 0.0) f.emission = emission_scale * share * vec3(all.emission);
        f.leaves = all.leaves;
        f.offset = share * float(all.offset);
        f.area = float(all.area) / k_fixed;
        count = float(all.count);
    }
    float size = length(f.normal), offset = 1.0;
    // The mean of the planes' equations is a plane; in a corner rays would pass beside it.
    if (planes && averaging != 0 && size > plane_coherence) offset = clamp(f.offset / size, -0.87, 0.87);
    if (emission_share == 1 && averaging >= 2 && f.emission != vec3(0.0)) {
        // Of a small body in the voxel a quarter of its surface is seen on average, in front of a quarter of the voxel's.
        float shown = size > 0.3 ? plane_area_in_voxel(f.normal / size, clamp(f.offset / size, -0.8, 0.8)) : 6.0;
        f.emission *= count / max(max(shown, f.area), 0.01);
    }
    if (f.leaves == 0u) f.leaves = leaves_of(size > 0.0 ? f.normal / size : vec3(0.0), size < 0.1);
    if (f.leaves == 0u) f.leaves = 63u;
    imageStore(voxels_albedo, voxel, vec4(f.albedo, 1.0));
    imageStore(voxels_normal, voxel, vec4(f.normal, offset));
    if (emission_scale > 0.0) imageStore(voxels_emission, voxel, vec4(f.emission, 1.0));
    imageStore(voxels_flags, voxel, uvec4(kind | (f.leaves << 2)));
}
