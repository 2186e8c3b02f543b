// Glossy indirect light from visibility lists: radiance over what the lobe reflects of even light. As published, the mean of
// what is visible, weighted by Eq. 7.
#define GLOSS
#include "vf/gather_lists.glsl"
