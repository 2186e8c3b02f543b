#ifndef ISM_VPL_GLSL
#define ISM_VPL_GLSL
// Virtual point lights, and where a direction lies in one's paraboloid map (Ritschel et al. 2008). passes/ism/vpl.h mirrors
// the struct.

// 48 bytes in std430.
struct Vpl {
    vec3 position;
    float area;     // m² of surface that it stands for
    vec3 normal;
    float padding_a;
    vec3 intensity; // W/sr along the normal
    float padding_b;
};

// A frame around n (Duff et al. 2017). Columns: t, b, n.
mat3 vpl_frame(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// A unit direction in the frame, z ≥ 0, to −1 … 1: x/(1 + z); and back.
vec2 to_paraboloid(vec3 d) {
    return d.xy / (1.0 + d.z);
}
vec3 from_paraboloid(vec2 p) {
    float squared = dot(p, p);
    return vec3(2.0 * p, 1.0 - squared) / (1.0 + squared);
}

// The atlas holds rows of `across` maps.
ivec2 map_corner(int vpl, int side, int across) {
    return side * ivec2(vpl % across, vpl / across);
}
#endif
