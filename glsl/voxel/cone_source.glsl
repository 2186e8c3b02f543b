#ifndef VOXEL_CONE_SOURCE_GLSL
#define VOXEL_CONE_SOURCE_GLSL
// What a shader that sends cones needs of the volume that they go through, whichever it is. GLSL has no interfaces, so that
// each source defines these functions, and a shader includes one source and then what sends the cones:
//   voxel/cone.glsl  occlusion voxels; no light
//   lrsm/cone.glsl   occlusion voxels, and light from layered reflective shadow maps
//   dvs/cone.glsl    directional volumes of radiance
#include "lib/voxel_grid.glsl"

struct VoxelGrid {
    vec3 origin; // metres
    float side;
    float voxel; // metres
    int resolution;
    int leaves;    // 1, or 6
    int mips;      // that the volume has
    int skip_mips; // the coarsest mip in which a single voxel still shows
};

// Where a cone leaves a surface: what lies between `surface` and `apex` is too near for voxels to tell it from the surface.
struct ConeStart {
    vec3 surface; // world
    vec3 face;    // its plane's normal
    vec3 apex;    // normal_offset voxels off it
};

VoxelGrid cone_grid();

// α of a sphere, as seen along `direction`; 0 outside the grid.
float sphere_occlusion(VoxelGrid grid, vec3 position, vec3 direction, float level);

struct ConeLight {
    vec3 radiance;
    float occlusion;
    float away; // metres to what blocks the cone; below 0: nothing, or the cone fades without a place
};

// Of the sources that hold light. `diameter`: 2·tan(θ/2), metres a metre.
ConeLight light_along_cone(VoxelGrid grid, ConeStart start, vec3 direction, float diameter);

#endif
