#ifndef TRACED_SCENE_GLSL
#define TRACED_SCENE_GLSL
// The scene's buffers, for those who ask more of a hit than where it is. Who does not is not to declare them: a storage
// block counts against the driver's limit even if nothing reads it, and some drivers then mistake the length of others.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#ifndef WITHOUT_LIGHTS // of whom a storage block less is asked
#define SCENE_LIGHTS   // for those who include this: lib/scene.glsl is read once
#endif
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"
#endif
