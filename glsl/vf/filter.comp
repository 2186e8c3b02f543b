// The visibility filter (VF, Eq. 4): each texel's list becomes the union of the lists around it, over (2m + 1)² texels whose
// surfaces agree in depth and normal. Lists are in order, so the union is a merge: no cell is in it twice, and what was seen
// and crossed adds up. With `hysteresis` the list that the same place had in the last frame joins in, with its counts reduced.
#include "lib/frame.glsl"
#include "vf/lists.glsl"
#include "surface/start.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer vf_lists { uint lists[]; };
layout(std430) writeonly buffer vf_filtered { uint filtered[]; };
layout(std430) buffer vf_counts { uint counts[]; };
layout(std430) readonly buffer vf_previous { uint previous[]; }; //! optional

layout(std430) readonly buffer vf_sizes { ivec2 march_size; int list_capacity, filtered_capacity; };

uniform int reach = 3;                   //! [0, 5] (texels) m: to either side; 3 as published (7 × 7)
uniform int depth_test = 0;              //! {depth, plane} what must agree: distance along the view, or distance to the texel's plane
uniform float depth_tolerance = 0.02;    //! [1e-4, 1] depth: as a share of the texel's own
uniform float plane_tolerance = 0.01;    //! [1e-4, 1] plane: as a share of the scene's diagonal
uniform float least_cosine = 0.9;        //! [-1, 1] between normals that agree

uniform float hysteresis = 0.0;          //! [0, 0.98] how much of the last frame's counts stays (a slot vf.previous must be bound)

const int k_most = 121;

#ifdef HAS_vf_previous
// Where the list of this place began in the last frame, or −1: the surface was not in the picture, or another hid it.
int previous_list(StartPoint own) {
    vec4 clip = previous_view_projection * vec4(own.position, 1.0);
    vec2 at = clip.xy / clip.w * 0.5 + 0.5;
    if (hysteresis <= 0.0 || clip.w <= 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) return -1;
    int from = list_start(ivec2(at * vec2(march_size)), march_size, filtered_capacity);
    vec3 there = uintBitsToFloat(uvec3(previous[from + 1], previous[from + 2], previous[from + 3]));
    bool same = previous[from] > 0u && abs(dot(own.face, there - own.position)) < plane_tolerance * scene_diagonal;
    return same ? from : -1;
}
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, march_size))) return;
    int to = list_start(texel, march_size, filtered_capacity);
    StartPoint own;
    if (!start_at(pixel_of(texel, march_size), own)) {
        for (int k = 0; k < k_list_header; ++k) filtered[to + k] = 0u;
        return;
    }
    float along = dot(own.position - camera_position, camera_forward);
    // The lists that agree: where the next entry of each is, and how many are left.
    int next_of[k_most], left_of[k_most];
    int joined = 0;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            ivec2 at = texel + ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, march_size))) continue;
            StartPoint other;
            if (!start_at(pixel_of(at, march_size), other)) continue;
            vec3 apart = other.position - own.position;
            bool near = depth_test == depth_test_plane ? abs(dot(own.face, apart)) < plane_tolerance * scene_diagonal
                                                       : abs(dot(apart, camera_forward)) < depth_tolerance * along;
            if (!near || dot(own.normal, other.normal) < least_cosine) continue;
            int from = list_start(at, march_size, list_capacity);
            left_of[joined] = int(lists[from]);
            next_of[joined++] = from + k_list_header;
        }
    }
    int length_of_union = 0, wanted = 0;
#ifdef HAS_vf_previous
    int before = previous_list(own), left_before = before < 0 ? 0 : int(previous[before]);
    before += k_list_header;
#endif
    for (;;) {
        uint lowest = 0xffffffffu;
        for (int k = 0; k < joined; ++k)
            if (left_of[k] > 0) lowest = min(lowest, lists[next_of[k]]);
#ifdef HAS_vf_previous
        if (left_before > 0) lowest = min(lowest, previous[before]);
#endif
        if (lowest == 0xffffffffu) break;
        uvec2 sum = uvec2(0u);
#ifdef HAS_vf_previous
        if (left_before > 0 && previous[before] == lowest) {
            sum = uvec2(hysteresis * vec2(unpacked_counts(previous[before + 1])));
            before += 2;
            --left_before;
        }
#endif
        for (int k = 0; k < joined; ++k) {
            if (left_of[k] <= 0 || lists[next_of[k]] != lowest) continue;
            sum += unpacked_counts(lists[next_of[k] + 1]);
            next_of[k] += 2;
            --left_of[k];
        }
        if (sum.y == 0u) continue;
        ++wanted;
        if (length_of_union == filtered_capacity) continue;
        filtered[to + k_list_header + 2 * length_of_union] = lowest;
        filtered[to + k_list_header + 2 * length_of_union + 1] = packed_counts(sum.x, sum.y);
        ++length_of_union;
    }
    filtered[to] = uint(length_of_union);
    for (int k = 0; k < 3; ++k)
        filtered[to + 1 + k] = floatBitsToUint(own.position[k]);
    atomicMax(counts[2], uint(wanted));
    if (wanted > length_of_union) atomicAdd(counts[3], uint(wanted - length_of_union));
}
