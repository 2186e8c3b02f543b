#ifndef TRACED_LIGHT_TABLES_GLSL
#define TRACED_LIGHT_TABLES_GLSL
// Points of emissive triangles and directions of the environment, drawn by power, with their densities per solid angle.
// passes/traced/light_tables.cpp makes the tables. Include lib/material_model.glsl before this file.
#include "lib/environment.glsl"
#include "traced/surface.glsl"

layout(std430) readonly buffer traced_light_tables { uint light_tables[]; }; //! optional
layout(std430) readonly buffer traced_emitters { uint any_are_there[]; };    //! optional // tells only that there are some

struct LightSample {
    vec3 direction; // unit, from the surface
    vec3 to_end;    // from where rays leave the surface to the light; sky: the direction
    float reach;    // in lengths of to_end
    vec3 radiance;
    float density;  // 0: nothing to add
};

#ifdef HAS_traced_light_tables
uint table_word(uint i) {
    return light_tables[i];
}

// The first of `count` entries, `stride` words apart from `at` on, whose running share passes `choice`; what is left of
// `choice` within it.
uint draw_entry(uint at, uint stride, uint count, inout float choice) {
    uint low = 0u, high = count - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (uintBitsToFloat(light_tables[at + stride * middle]) > choice) high = middle;
        else low = middle + 1u;
    }
    float before = low > 0u ? uintBitsToFloat(light_tables[at + stride * (low - 1u)]) : 0.0;
    float share = uintBitsToFloat(light_tables[at + stride * low]) - before;
    choice = share > 0.0 ? clamp((choice - before) / share, 0.0, 0.99999994) : 0.5;
    return low;
}

float solid_angle_density(float by_area, float distance2, float cosine) {
    return cosine > 1.0e-7 ? by_area * distance2 / cosine : 0.0;
}

#ifdef HAS_traced_emitters
bool any_emitters() {
    return table_word(0u) > 0u;
}

LightSample draw_emitter(TracedSurface from, float choice, vec2 u) {
    LightSample drawn = LightSample(vec3(0.0), vec3(0.0), 1.0, vec3(0.0), 0.0);
    uint entry = table_word(2u) + 4u * draw_entry(table_word(2u), 4u, table_word(0u), choice);
    Draw draw = draws[light_tables[entry + 2u]];
    uint corner = light_tables[entry + 3u];
    Material material = materials[draw.material];
    Vertex corners[3];
    vec3 positions[3];
    for (int k = 0; k < 3; ++k) {
        corners[k] = vertices[indices[corner + uint(k)]];
        positions[k] = (draw.world * vec4(corners[k].position_u.xyz, 1.0)).xyz;
    }
    float root = sqrt(u.x), b = root * (1.0 - u.y), c = root * u.y;
    vec3 edge1 = positions[1] - positions[0], edge2 = positions[2] - positions[0], across = cross(edge1, edge2);
    float twice_area = length(across);
    vec3 at = positions[0] + (b * edge1 + c * edge2), to_point = at - from.position;
    float distance2 = dot(to_point, to_point);
    if (!(distance2 > 0.0) || !(twice_area > 0.0)) return drawn;
    drawn.direction = to_point / sqrt(distance2);
    vec3 normal = across / twice_area;
    if (dot(normal, drawn.direction) > 0.0) normal = -normal;
    drawn.density = solid_angle_density(uintBitsToFloat(light_tables[entry + 1u]) / (0.5 * twice_area), distance2, -dot(normal, drawn.direction));
    float from_afar = 16.0 * k_rounding * dot(abs(normal), abs(to_point));
    drawn.to_end = at + (safe_offset(at, edge1, edge2, normal) + from_afar) * normal - start_off(from);
    TrianglePoint point = triangle_point_of(corners, vec3(1.0 - b - c, b, c), 1.0);
    drawn.radiance = material.emission * sample_at_point(material.emission_texture, point, 0.0).rgb;
    if (alpha_matters(material)) {
        float alpha = material.base_colour.a * point.colour.a * sample_at_point(material.base_colour_texture, point, 0.0).a;
        drawn.radiance *= material.alpha_cutoff < 0.0 ? alpha : (alpha >= mask_threshold(material.alpha_cutoff) ? 1.0 : 0.0);
    }
    return drawn;
}

// With which draw_emitter would have drawn the point that a ray from `from` met.
float emitter_density(vec3 from, TracedHit hit, TracedSurface met, vec3 direction) {
    if (!any_emitters()) return 0.0;
    uint first = light_tables[table_word(1u) + hit.draw];
    if (first == 0xffffffffu) return 0.0;
    Draw draw = draws[hit.draw];
    vec3 positions[3];
    for (int k = 0; k < 3; ++k) positions[k] = (draw.world * vec4(vertices[indices[hit.corner + uint(k)]].position_u.xyz, 1.0)).xyz;
    vec3 across = cross(positions[1] - positions[0], positions[2] - positions[0]), to_point = met.position - from;
    float twice_area = length(across);
    if (!(twice_area > 0.0)) return 0.0;
    uint entry = table_word(2u) + 4u * (first + (hit.corner - draw.first_index) / 3u);
    float cosine = abs(dot(across, direction)) / (twice_area * length(direction));
    return solid_angle_density(uintBitsToFloat(light_tables[entry + 1u]) / (0.5 * twice_area), dot(to_point, to_point), cosine);
}

#endif

// Whether directions are drawn from a map. A constant environment is found well enough by the surface's own lobes.
bool sky_is_drawn() {
    return environment_map != 0 && table_word(3u) > 0u;
}

float sky_region_density(uint region, uint columns, uint rows) {
    uint at = table_word(5u);
    float share = uintBitsToFloat(light_tables[at + region]) - (region > 0u ? uintBitsToFloat(light_tables[at + region - 1u]) : 0.0);
    float row = float(region / columns);
    float height = cos(k_pi * row / float(rows)) - cos(k_pi * (row + 1.0) / float(rows));
    return share * float(columns) / (2.0 * k_pi * height);
}

float sky_density(vec3 direction) {
    if (!sky_is_drawn()) return 0.0;
    uint columns = table_word(3u), rows = table_word(4u);
    vec2 uv = vec2(atan(direction.z, direction.x) / (2.0 * k_pi) + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / k_pi);
    uvec2 region = min(uvec2(uv * vec2(columns, rows)), uvec2(columns - 1u, rows - 1u));
    return sky_region_density(region.y * columns + region.x, columns, rows);
}

// Within a region directions are uniform over its solid angle.
LightSample draw_sky(float choice, vec2 u) {
    uint columns = table_word(3u), rows = table_word(4u);
    uint region = draw_entry(table_word(5u), 1u, columns * rows, choice);
    float upper = cos(k_pi * float(region / columns) / float(rows)), lower = cos(k_pi * float(region / columns + 1u) / float(rows));
    float cosine = mix(upper, lower, u.y), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float azimuth = ((float(region % columns) + u.x) / float(columns) - 0.5) * 2.0 * k_pi;
    vec3 direction = vec3(cos(azimuth) * sine, cosine, sin(azimuth) * sine);
    return LightSample(direction, direction, 3.0e38, environment(direction), sky_region_density(region, columns, rows));
}
#endif

// What is not there is never drawn.
#if !defined(HAS_traced_emitters) || !defined(HAS_traced_light_tables)
bool any_emitters() {
    return false;
}
LightSample draw_emitter(TracedSurface from, float choice, vec2 u) {
    return LightSample(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), 0.0);
}
float emitter_density(vec3 from, TracedHit hit, TracedSurface met, vec3 direction) {
    return 0.0;
}
#endif
#ifndef HAS_traced_light_tables
bool sky_is_drawn() {
    return false;
}
LightSample draw_sky(float choice, vec2 u) {
    return LightSample(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), 0.0);
}
float sky_density(vec3 direction) {
    return 0.0;
}
#endif

#endif
