#ifndef LRSM_VIEW_EXTENT_GLSL
#define LRSM_VIEW_EXTENT_GLSL
// The scene's extent along a light's view, in metres: from where to where partitions of depth reach.
vec2 view_extent(ShadowView view) {
    vec3 to_least = scene_min - view.origin, to_most = scene_max - view.origin;
    vec3 a = to_least * view.direction, b = to_most * view.direction;
    vec3 least = min(a, b), most = max(a, b);
    float nearest = max(least.x + least.y + least.z, view.range > 0.0 ? 0.0 : view.near_plane);
    return vec2(nearest, max(most.x + most.y + most.z, nearest + 1.0e-6 * scene_diagonal));
}
#endif
