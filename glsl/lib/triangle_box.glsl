#ifndef LIB_TRIANGLE_BOX_GLSL
#define LIB_TRIANGLE_BOX_GLSL
// Exact overlap of a triangle and a voxel by separating axes (Akenine-Möller, "Fast 3D triangle-box overlap testing",
// 2001; arranged as in Schwarz & Seidel, "Fast parallel surface and solid voxelization on GPUs", 2010). Touching counts
// as overlap. Voxel units: the voxel is [v, v + 1]³.

// The axis cross(edge, unit axis) separates: in the plane of the two other axes (p, q: their coordinates).
bool edge_separates(vec2 edge, vec2 from, vec2 opposite, vec2 low) {
    vec2 normal = vec2(-edge.y, edge.x);
    if (dot(normal, opposite - from) < 0.0) normal = -normal;
    // The corner of the square that lies farthest along the inward normal must not be before the edge.
    return dot(normal, low + step(vec2(0.0), normal) - from) < 0.0;
}

bool triangle_overlaps_voxel(vec3 a, vec3 b, vec3 c, ivec3 voxel) {
    vec3 low = vec3(voxel);
    if (any(greaterThan(min(a, min(b, c)), low + 1.0)) || any(lessThan(max(a, max(b, c)), low))) return false;
    vec3 normal = cross(b - a, c - a);
    float from_centre = dot(normal, low + 0.5 - a);
    vec3 reach = 0.5 * abs(normal);
    if (abs(from_centre) > reach.x + reach.y + reach.z) return false;
    vec3 corners[3] = vec3[3](a, b, c);
    for (int i = 0; i < 3; ++i) {
        vec3 from = corners[i], to = corners[(i + 1) % 3], opposite = corners[(i + 2) % 3];
        vec3 edge = to - from;
        if (edge_separates(edge.xy, from.xy, opposite.xy, low.xy) || edge_separates(edge.yz, from.yz, opposite.yz, low.yz) ||
            edge_separates(edge.zx, from.zx, opposite.zx, low.zx))
            return false;
    }
    return true;
}

// Whether floats can tell which voxels a triangle's plane crosses, given the cross product of its edges: not with edges of
// some 10⁷ voxels, as stray vertices have them.
bool is_within_floats(vec3 normal) {
    return dot(normal, normal) < 1.0e30;
}

// The axis along which the triangle's projection is largest: 0, 1, 2.
int dominant_axis(vec3 normal) {
    vec3 size = abs(normal);
    return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

#endif
