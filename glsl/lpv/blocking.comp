// The geometry volume (LPV, section 3.4): each cell's surfels are added up view by view, and of the views the one counts that
// sees most: they see the same surfaces.
layout(local_size_x = 64) in;

layout(std430) readonly buffer lpv_surfels { vec4 surfels[]; };
layout(std430) readonly buffer lpv_surfel_ranges { uvec2 ranges[]; };
layout(std430) writeonly buffer lpv_blocking { vec4 blockers[]; };

void main() {
    int cell = int(gl_GlobalInvocationID.x);
    if (cell >= blockers.length()) return;
    vec4 most = vec4(0.0), sum = vec4(0.0);
    float view = -1.0;
    uvec2 range = ranges[cell];
    for (uint i = range.x; i < range.y; ++i) {
        vec4 surfel = surfels[i];
        if (surfel.w != view) {
            if (sum.w > most.w) most = sum;
            sum = vec4(0.0);
            view = surfel.w;
        }
        sum += vec4(surfel.xyz, length(surfel.xyz));
    }
    blockers[cell] = sum.w > most.w ? sum : most;
}
