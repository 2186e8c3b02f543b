#ifndef LPV_ORDINATES_GLSL
#define LPV_ORDINATES_GLSL
// Discrete ordinates: directions on a spherical Fibonacci lattice, each for 4π/N of the sphere, turned off the axes that walls
// follow. A cell's radiance along one is stored as halves.

uniform int directions = 48; //! [0, 256] ordinates of all directions; 0: none

vec3 ordinate(int m) {
    float z = 1.0 - (2.0 * float(m) + 1.0) / float(directions), turn = 2.39996322973 * float(m);
    // By 0.9 about (1, 2, 3).
    const mat3 k_tilt = mat3(0.64863783, 0.68211449, -0.33762227, -0.57400305, 0.72972141, 0.37152007, 0.49978942, -0.04718577, 0.86486070);
    return k_tilt * vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
}

uvec2 packed_light(vec3 light) {
    light = min(light, vec3(65504.0));
    return uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 0.0)));
}
vec3 unpacked_light(uvec2 bits) {
    return vec3(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y).x);
}
#endif
