#ifndef LDM_VIEWED_MAP_GLSL
#define LDM_VIEWED_MAP_GLSL
// The map that a debug view shows. The view takes its steps in the maps' loop, and shows it in the step that holds it.
#include "ldm/walk.glsl"

uniform int iteration;
uniform int map = 0; //! [0, 4095] number of the map

int viewed_map() {
    return min(map, ldm.maps - 1);
}
bool is_viewed_now() {
    return viewed_map() % ldm.batches == iteration;
}
int viewed_slot() {
    return viewed_map() / ldm.batches;
}
#endif
