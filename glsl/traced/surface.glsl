#ifndef TRACED_SURFACE_GLSL
#define TRACED_SURFACE_GLSL
// The surface where a ray hit, seen from the ray's side.
#include "lib/material_model.glsl"
#include "traced/hit.glsl"
#include "traced/scene.glsl"

struct TracedSurface {
    vec3 position;
    float offset; // metres: rays that leave start so far off the surface, along `face`
    vec3 face;    // unit normal of the triangle, toward the viewer
    vec3 shading; // interpolated, normal-mapped; on the same side
    vec3 base_colour;
    float metallic, roughness;
    vec3 emission;
};

const float k_rounding = 5.9604645e-8; // half of the last place of 1

vec3 start_off(TracedSurface s) {
    return s.position + s.offset * s.face;
}

// By how much a ray must start off a triangle so as not to hit it, as far as the numbers of the point and of the
// intersection can be off (as in PBRT, section 6.8.4; passes/reference/geometry.h).
float safe_offset(vec3 position, vec3 edge1, vec3 edge2, vec3 normal) {
    vec3 extent = abs(edge1) + abs(edge2);
    vec3 error = k_rounding * (3.0 * abs(position) + 16.0 * extent);
    return dot(abs(normal), error) + 4.0 * k_rounding * max(extent.x, max(extent.y, extent.z));
}

vec3 unit_or(vec3 v, vec3 otherwise) {
    float size2 = dot(v, v);
    return size2 > 1.0e-37 && size2 < 1.0e37 ? v / sqrt(size2) : otherwise;
}

const int k_with_normal_maps = 1, k_with_emission = 2;

// `parts`: what is looked up beside base colour and metallic. Textures are read as they are, without mips, as the reference
// does.
TracedSurface surface_at(TracedHit hit, vec3 direction, int parts) {
    Draw draw = draws[hit.draw];
    Material material = materials[draw.material];
    Vertex corners[3];
    vec3 positions[3];
    for (int k = 0; k < 3; ++k) {
        corners[k] = vertices[indices[hit.corner + uint(k)]];
        positions[k] = (draw.world * vec4(corners[k].position_u.xyz, 1.0)).xyz;
    }
    vec3 weight = vec3(1.0 - hit.uv.x - hit.uv.y, hit.uv), edge1 = positions[1] - positions[0], edge2 = positions[2] - positions[0];
    vec3 across = cross(edge1, edge2);
    TracedSurface s;
    s.position = positions[0] + (hit.uv.x * edge1 + hit.uv.y * edge2);
    s.face = unit_or(across, -normalize(direction));
    if (dot(s.face, direction) > 0.0) s.face = -s.face;
    s.offset = safe_offset(s.position, edge1, edge2, s.face);
    TrianglePoint point = triangle_point_of(corners, weight, 1.0);

    vec3 normal = vec3(0.0);
    for (int k = 0; k < 3; ++k) normal += weight[k] * world_normal(draw, corners[k].normal_v.xyz);
    normal = unit_or(normal, s.face);
    if ((parts & k_with_normal_maps) != 0 && normal_maps != 0 && material.normal_texture.array >= 0) {
        vec3 tangent = vec3(0.0);
        float handedness = 0.0;
        for (int k = 0; k < 3; ++k) {
            vec4 t = world_tangent(draw, corners[k].tangent);
            tangent += weight[k] * t.xyz;
            handedness += weight[k] * t.w;
        }
        vec3 local = sample_at_point(material.normal_texture, point, 0.0).xyz * 2.0 - 1.0;
        local.xy *= material.normal_scale;
        tangent -= normal * dot(normal, tangent);
        if (dot(tangent, tangent) > 1.0e-12) {
            tangent = normalize(tangent);
            normal = unit_or(local.x * tangent + local.y * handedness * cross(normal, tangent) + local.z * normal, normal);
        }
    }
    s.shading = dot(normal, s.face) < 0.0 ? -normal : normal;
    s.base_colour = material.base_colour.rgb * point.colour.rgb * sample_at_point(material.base_colour_texture, point, 0.0).rgb;
    vec2 rm = vec2(material.roughness, material.metallic) * sample_at_point(material.metallic_roughness_texture, point, 0.0).gb;
    s.roughness = rm.x;
    s.metallic = rm.y;
    s.emission = (parts & k_with_emission) != 0 ? material.emission * sample_at_point(material.emission_texture, point, 0.0).rgb : vec3(0.0);
    return s;
}

#endif
