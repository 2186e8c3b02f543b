// Diffuse indirect light from visibility lists: E/π.
#include "vf/gather_lists.glsl"
