#ifndef LIB_NORMAL_MAP_GLSL
#define LIB_NORMAL_MAP_GLSL
vec3 unit_or(vec3 v, vec3 otherwise) {
    float size = length(v);
    return size > 0.0 ? v / size : otherwise;
}

// The shading normal of a raster pass: the authored one, turned by the material's normal map. Include
// lib/material_raster.glsl first; `mapped` is the map's texel as stored, fetched before any discard. The bitangent
// cross(n, t)·w lies along −v, where the map's green points (glTF 2.0 §3.9.3).
vec3 shading_normal(Material material, vec3 authored, vec4 tangent, vec3 mapped) {
    if (material.normal_texture.array < 0 || normal_maps == 0) return authored;
    vec3 t = tangent.xyz - authored * dot(authored, tangent.xyz);
    if (dot(t, t) <= 1.0e-12) return authored;
    t = normalize(t);
    vec3 b = cross(authored, t) * tangent.w;
    vec3 local = mapped * 2.0 - 1.0;
    local.xy *= material.normal_scale;
    vec3 turned = t * local.x + b * local.y + authored * local.z;
    return dot(turned, turned) > 1.0e-12 ? normalize(turned) : authored;
}
#endif
