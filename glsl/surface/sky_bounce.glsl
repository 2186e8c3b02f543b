#ifndef SURFACE_SKY_BOUNCE_GLSL
#define SURFACE_SKY_BOUNCE_GLSL
// What the environment makes a point of a surface send back, by reflective shadow maps of it (the pass `rsm` of=environment):
// each shows what parallel light from one direction reaches. Where there are none the neutral view shows nothing.
#include "surface/map_light.glsl"

uniform sampler2DArray sky_radiance; //! optional
uniform sampler2DArray sky_normal;   //! optional
uniform sampler2DArray sky_depth;    //! optional
layout(std430) readonly buffer sky_views { ShadowView views_from_sky[]; }; //! optional

// The point may lie `off` metres off the surface.
vec3 sky_bounce(vec3 position, vec3 direction, float off) {
    vec3 light = vec3(0.0);
    for (int i = 0; i < views_from_sky.length(); ++i)
        light += light_in_view(sky_radiance, sky_normal, sky_depth, views_from_sky[i], i, position, direction, off);
    return light;
}

#endif
