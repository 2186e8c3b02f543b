// After entries were added to the list: cuts the count to what the list holds, and sets the groups of dispatches over it.
#include "dvs/list_build.glsl"

layout(local_size_x = 1) in;

uniform uint kind;

void main() {
    uint capacity = uint(list.length());
    overflow = listed > capacity ? listed - capacity : 0u;
    listed = min(listed, capacity);
    if (kind == k_static) static_listed = listed;
    uint count = (listed + 63u) / 64u;
    groups = uvec3(min(count, k_groups_a_row), (count + k_groups_a_row - 1u) / k_groups_a_row, 1u);
}
