// The gather (LPV, section 3.5): the intensity toward −n of the cells around the point, as if it came from half a cell away.
#include "lpv/gather.glsl"
#include "lpv/light.glsl"

layout(std430) readonly buffer lpv_sum { mat3x4 sums[]; };

uniform int irradiance = 0;   //! {intensity, flux} I(−n) from half a cell away (published), or such that a cell's whole flux arrives
uniform float damping = 1.0;  //! [0, 2] how much light darkens that grows along the normal against its own direction

mat3x4 light_at(int cascade, Corners corners) {
    mat3x4 sum = mat3x4(0.0);
    for (int k = 0; k < 8; ++k)
        sum += corners.weight[k] * sums[cascade * cells_of_cascade() + int(cell_index(corner_cell(corners, k), grid_size()))];
    return sum;
}

vec3 irradiance_at(int cascade, vec3 x, vec3 face, vec3 n) {
    vec3 place = to_cells(cascades[cascade], x) + shift * face;
    Corners corners = corners_at(place);
#if in_front
    leave_out_hidden(corners, cascade, x, face);
#endif
    mat3x4 light = light_at(cascade, corners);
    vec4 toward = harmonics_of(-n);
    // Intensities are per s² already: 1/(s/2)² is 4. The other is ∮ over a cell's faces.
    vec3 level = k_y0 * vec3(light[0].x, light[1].x, light[2].x), along = toward * light - level;
    vec3 result = irradiance == irradiance_intensity ? 4.0 * k_inverse_pi * (level + along) : k_inverse_pi * (2.094 * level + 1.916 * along);
    if (damping > 0.0) {
        mat3x4 growth = light_at(cascade, corners_at(place + 0.5 * face)) - light_at(cascade, corners_at(place - 0.5 * face));
        const vec3 k_bright = vec3(0.2126, 0.7152, 0.0722);
        vec3 axis = (light * k_bright).yzw, change = (growth * k_bright).yzw;
        float size = length(axis), steep = length(change);
        if (size > 0.0 && steep > 0.0) result *= clamp(1.0 + damping * min(dot(axis, change) / (size * steep), 0.0) * min(steep / size, 1.0), 0.0, 1.0);
    }
    return max(result, vec3(0.0));
}
