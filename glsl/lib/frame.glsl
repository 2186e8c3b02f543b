#ifndef LIB_FRAME_GLSL
#define LIB_FRAME_GLSL
// The frame's constants, and what follows from them. passes/graph/frame_constants.h mirrors the block.

layout(std140) uniform Frame {
    mat4 view;            // world → camera
    mat4 projection;      // reversed depth: 1 at the near plane, 0 at infinity; row 0 at the top
    mat4 view_projection;
    mat4 inverse_view_projection;
    mat4 previous_view_projection;
    vec3 camera_position; // metres
    float time;           // seconds
    vec3 camera_right;
    float tan_half_vfov;
    vec3 camera_up;
    float near_plane;
    vec3 camera_forward;
    float aspect;
    vec3 scene_min; // bounds over the whole animation, without strays (passes/scene/extent.h)
    float scene_diagonal;
    vec3 scene_max;
    float delta_time;
    vec3 environment_radiance; // W/(sr·m²), times pre_exposure
    int environment_map;       // 1: multiply by the map
    ivec2 resolution;
    int frame_index;
    int light_count;
    int diffuse_only; // every material is Lambert with rho = base_colour·(1 − metallic)
    int shadow_view_count;
    int normal_maps;
    int material_model; // 0 plain, 1 gltf, 2 appendix_b: lib/material_model.glsl
    float pre_exposure; // all light is multiplied by this power of two; what is shown is divided by it
};

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
