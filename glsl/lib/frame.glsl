#ifndef LIB_FRAME_GLSL
#define LIB_FRAME_GLSL
// The frame's constants, and what follows from them. passes/gpu_scene/frame_constants.cpp lists them. Plain uniforms: only
// those that a program really uses make its pass depend on them.

uniform mat4 view;       // world → camera
uniform mat4 projection; // reversed depth: 1 at the near plane, 0 at infinity; row 0 at the top
uniform mat4 view_projection;
uniform mat4 inverse_view_projection;
uniform mat4 previous_view_projection; // whoever reads it follows the camera's motion: its history outlasts it
uniform vec3 camera_position;          // metres
uniform vec3 camera_right;
uniform vec3 camera_up;
uniform vec3 camera_forward;
uniform float tan_half_vfov;
uniform float near_plane;
uniform float aspect;
uniform ivec2 resolution;
uniform float time; // seconds
uniform float delta_time;
uniform int frame_index;
uniform vec3 scene_min; // bounds over the whole animation, without strays (passes/scene/extent.h)
uniform vec3 scene_max;
uniform float scene_diagonal;
uniform vec3 environment_radiance; // W/(sr·m²), times pre_exposure
uniform int environment_map;       // 1: multiply by the map
uniform int light_count;
uniform int diffuse_only; // every material is Lambert with rho = base_colour·(1 − metallic)
uniform int shadow_view_count;
uniform int normal_maps;
uniform int material_model; // 0 plain, 1 gltf, 2 appendix_b: lib/material_model.glsl
uniform float pre_exposure; // all light is multiplied by this power of two; what is shown is divided by it

// The direction through a pixel's centre, with a forward component of 1 (so that distance along the view is a factor).
vec3 pixel_ray(vec2 pixel) {
    vec2 plane = (pixel + 0.5) / vec2(resolution) * 2.0 - 1.0;
    return camera_forward + tan_half_vfov * (plane.x * aspect * camera_right - plane.y * camera_up);
}

// World position of a pixel's surface from the depth buffer (near / distance); meaningless where depth is 0 (background).
vec3 world_position(ivec2 pixel, float depth) {
    return camera_position + pixel_ray(vec2(pixel)) * (near_plane / depth);
}

// World position → pixel coordinates (xy, pixel centres at .5) and distance along the view (z).
vec3 project_to_pixel(vec3 position) {
    vec4 clip = view_projection * vec4(position, 1.0);
    return vec3((clip.xy / clip.w * 0.5 + 0.5) * vec2(resolution), clip.w);
}

#endif
