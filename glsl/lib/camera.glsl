#ifndef LIB_CAMERA_GLSL
#define LIB_CAMERA_GLSL
// The camera: right-handed look-at, vertical field of view, row 0 at the top. passes/scene/camera_ray.h mirrors this file.

// Columns: right, up, forward (unit). An `up` along the view falls back to another axis.
mat3 camera_basis(vec3 position, vec3 target, vec3 up) {
    vec3 forward = normalize(target - position);
    vec3 across = cross(forward, up);
    if (dot(across, across) < 1.0e-12 * dot(up, up)) {
        across = cross(forward, abs(forward.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
    }
    vec3 right = normalize(across);
    return mat3(right, cross(right, forward), forward);
}

// The unit direction through `pixel` (pixels, (0.5, 0.5) is the centre of the top left one) of an image of `size` pixels.
vec3 camera_ray(mat3 basis, float tan_half_vfov, vec2 size, vec2 pixel) {
    vec2 plane = vec2(2.0 * pixel.x - size.x, size.y - 2.0 * pixel.y) * (tan_half_vfov / size.y);
    return normalize(basis * vec3(plane, 1.0));
}

#endif
