// The gather by ordinates: the cosine-weighted mean of the radiance that arrives from all directions at the cells around the point.
#include "lpv/gather.glsl"
#include "lpv/ordinates.glsl"

layout(std430) readonly buffer lpv_ordinates { uvec2 ordinates[]; };

// E/π; a field that is the same everywhere gives itself.
vec3 irradiance_at(int cascade, vec3 x, vec3 face, vec3 n) {
    Corners corners = corners_at(to_cells(cascades[cascade], x) + shift * face);
#if in_front
    leave_out_hidden(corners, cascade, x, face);
#endif
    int count = cells_of_cascade(), cells[8];
    for (int k = 0; k < 8; ++k)
        cells[k] = cascade * count + int(cell_index(corner_cell(corners, k), grid_size()));
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int m = 0; m < directions; ++m) {
        float cosine = -dot(ordinate(m), n);
        if (cosine <= 0.0) continue;
        total += cosine;
        for (int k = 0; k < 8; ++k)
            if (corners.weight[k] > 0.0) sum += cosine * corners.weight[k] * unpacked_light(ordinates[m * grid_cascades * count + cells[k]]);
    }
    return sum / max(total, 1.0e-6);
}
