#ifndef LIB_HEAT_COLOUR_GLSL
#define LIB_HEAT_COLOUR_GLSL
// A share from 0 to 1 as a colour: black, blue, magenta, orange, yellow, white.
vec3 heat_colour(float share) {
    float x = clamp(share, 0.0, 1.0) * 5.0;
    vec3 stops[6] = vec3[6](vec3(0.0), vec3(0.05, 0.05, 0.6), vec3(0.6, 0.05, 0.55), vec3(1.0, 0.35, 0.05), vec3(1.0, 0.9, 0.1), vec3(1.0));
    int i = min(int(x), 4);
    return mix(stops[i], stops[i + 1], x - float(i));
}
#endif
