#ifndef LIB_POLYGON_BOX_GLSL
#define LIB_POLYGON_BOX_GLSL
// How much of a polygon lies in a voxel: clipped by its six sides (Sutherland & Hodgman, "Reentrant polygon clipping", 1974).
// Voxel units, relative to the voxel's centre: the voxel is [−½, ½]³. A polygon of four corners has at most ten after that.

const int k_max_corners = 10;

float area_in_voxel(vec3 polygon[k_max_corners], int count) {
    vec3 clipped[k_max_corners];
    int sides = 6 + min(count, 0); // six, which compilers cannot know: unrolled, the loop takes seconds to compile
    for (int side = 0; side < sides; ++side) {
        int axis = side >> 1, kept = 0;
        float outward = (side & 1) == 0 ? 1.0 : -1.0;
        for (int i = 0; i < count; ++i) {
            vec3 from = polygon[i], to = polygon[i + 1 == count ? 0 : i + 1];
            float a = 0.5 - outward * from[axis], b = 0.5 - outward * to[axis];
            if (a >= 0.0 && kept < k_max_corners) clipped[kept++] = from;
            if ((a >= 0.0) != (b >= 0.0) && kept < k_max_corners) clipped[kept++] = mix(from, to, a / (a - b));
        }
        count = kept;
        for (int i = 0; i < kept; ++i)
            polygon[i] = clipped[i];
    }
    vec3 sum = vec3(0.0);
    for (int i = 2; i < count; ++i)
        sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * length(sum);
}

float triangle_area_in_voxel(vec3 a, vec3 b, vec3 c, ivec3 voxel) {
    vec3 polygon[k_max_corners];
    vec3 centre = vec3(voxel) + 0.5;
    polygon[0] = a - centre;
    polygon[1] = b - centre;
    polygon[2] = c - centre;
    return area_in_voxel(polygon, 3);
}

// Of the plane n·x = offset, n unit.
float plane_area_in_voxel(vec3 n, float offset) {
    vec3 t = normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(n, t);
    vec3 polygon[k_max_corners];
    polygon[0] = offset * n + 2.0 * (t + b);
    polygon[1] = offset * n + 2.0 * (t - b);
    polygon[2] = offset * n - 2.0 * (t + b);
    polygon[3] = offset * n - 2.0 * (t - b);
    return area_in_voxel(polygon, 4);
}

#endif
