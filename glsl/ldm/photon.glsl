#ifndef LDM_PHOTON_GLSL
#define LDM_PHOTON_GLSL
// Photon differentials (Schjøth et al. 2007; Igehy 1999): what is emitted at a surface, and what arrives at the next one.
// passes/ldm/photons.h mirrors the structs.

// A place where photons are split: each of the N axes takes one on, on the side that the surface faces. 128 bytes.
struct Emitter {
    vec3 position;
    float pitch_texel; // 0: there is none
    vec3 normal;       // toward where the light came from
    float padding_a;
    vec3 flux;         // per unit of ⟨n·ω_o⟩: times the cosine it is a photon's Φ, W
    float padding_b;
    vec4 incoming;     // unit ω_i, back to where the light came from
    vec4 du_position, dv_position; // D_u x, D_v x: metres from texel to texel on the surface
    vec4 du_direction, dv_direction; // D_u d, D_v d of the incoming direction d = −ω_i
};

// A photon that the camera sees arrive. 64 bytes.
struct Photon {
    vec3 position;
    float area;   // A of Eq. 4 (m²): of the ellipse inscribed in the footprint
    vec3 flux;    // Φ, W
    float padding_a;
    vec4 du, dv;  // D_u x, D_v x on the surface; du × dv faces the light
};

// Direction d's differential after a transfer over a distance t to a plane of normal n (Igehy 1999, Eq. 10): what reaches
// the plane slides along d.
vec3 transferred(vec3 dx, vec3 dd, float t, vec3 d, vec3 n) {
    vec3 moved = dx + t * dd;
    float along = dot(d, n);
    return moved - d * (dot(moved, n) / (abs(along) > 1.0e-4 ? along : (along < 0.0 ? -1.0e-4 : 1.0e-4)));
}

// The rotation that takes unit `from` to unit `to`, applied to v: α·v·ᾱ with the quaternion α(from, to). Opposite vectors
// have no one rotation: half a turn about any axis across.
vec3 rotated(vec3 from, vec3 to, vec3 v) {
    float c = dot(from, to);
    vec3 axis;
    float w;
    if (c < -0.999999) {
        axis = normalize(abs(from.x) < 0.9 ? cross(from, vec3(1.0, 0.0, 0.0)) : cross(from, vec3(0.0, 1.0, 0.0)));
        w = 0.0;
    } else {
        w = sqrt(0.5 * (1.0 + c));
        axis = cross(from, to) / (2.0 * w);
    }
    return v + 2.0 * cross(axis, cross(axis, v) + w * v);
}
#endif
