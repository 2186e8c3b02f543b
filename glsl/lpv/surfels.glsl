#ifndef LPV_SURFELS_GLSL
#define LPV_SURFELS_GLSL
// Pieces of surfaces that block light (LPV, section 3.4): the texels of the reflective shadow maps, then pixels of the G-buffer
// at a lower resolution.
#include "surface/map_texel.glsl"
#include "surface/start.glsl"

uniform ivec2 pixel_grid; // how many pixels are taken; 0: none

struct Surfel {
    vec3 position;
    vec3 normal;
    float area; // m²; 0: there is none
    int view;   // which map it is of; the G-buffer comes last
};

Surfel surfel_at(int i) {
    Surfel surfel = Surfel(vec3(0.0), vec3(0.0), 0.0, 0);
    ivec3 size = textureSize(rsm_depth, 0);
    int texels = size.x * size.y * size.z;
    if (i < texels) {
        ivec3 at = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
        MapTexel texel = map_texel(at);
        surfel.position = texel.position;
        surfel.normal = texel.normal;
        // At grazing angles texels cover areas that they do not know.
        surfel.area = texel.area / max(texelFetch(rsm_radiance, at, 0).a, 0.05);
        surfel.view = at.z;
        return surfel;
    }
    i -= texels;
    StartPoint start;
    if (!start_at(pixel_of(ivec2(i % pixel_grid.x, i / pixel_grid.x), pixel_grid), start)) return surfel;
    surfel.position = start.position;
    surfel.normal = start.face;
    vec3 to_viewer = (camera_position - start.position) / start.distance;
    // The pixel's section across its ray, as of a map's texel (surface/map_texel.glsl), over its cosine.
    float side = 2.0 * tan_half_vfov / float(pixel_grid.y), aslant = dot(camera_forward, -to_viewer), along = start.distance * aslant;
    surfel.area = side * side * along * along * aslant / max(dot(start.face, to_viewer), 0.05);
    surfel.view = size.z;
    return surfel;
}
#endif
