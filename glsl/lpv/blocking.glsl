#ifndef LPV_BLOCKING_GLSL
#define LPV_BLOCKING_GLSL
// The geometry volume (LPV, section 3.4): how likely light is stopped in a cell, in harmonics of l ≤ 1. A surfel of area A and
// normal n stops the share A/s²·⟨n·−ω⟩⁺ of what goes along ω. The volume's cells lie about the corners of the light's cells, one
// more along each side. Stored as (Σ n·A/s², Σ A/s²). `blockers` is its buffer.

int blocker_index(int cascade, ivec3 corner) {
    int side = grid_cells + 1;
    return ((cascade * side + corner.z) * side + corner.y) * side + corner.x;
}

// Interpolated in the middle of the face between two cells that are neighbours along `axis`.
vec4 blocker_between(int cascade, ivec3 a, ivec3 b, int axis) {
    ivec3 corner = max(a, b), u = ivec3(0), v = ivec3(0);
    u[(axis + 1) % 3] = 1;
    v[(axis + 2) % 3] = 1;
    return 0.25 * (blockers[blocker_index(cascade, corner)] + blockers[blocker_index(cascade, corner + u)] +
                   blockers[blocker_index(cascade, corner + v)] + blockers[blocker_index(cascade, corner + u + v)]);
}

// The lobe's ¼ + ½cos, toward where the light comes from.
float blocked_share(vec4 blocker, vec3 direction) {
    return clamp(0.25 * blocker.w - 0.5 * dot(blocker.xyz, direction), 0.0, 1.0);
}
#endif
