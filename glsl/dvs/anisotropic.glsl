#ifndef DVS_ANISOTROPIC_GLSL
#define DVS_ANISOTROPIC_GLSL
// One directional value from eight voxels (DVS, section VII; Crassin et al. 2011): in depth the near one before the far
// one, c = c_near + (1 − α_near)·c_far, then the mean over the four columns. Values are premultiplied; children are indexed
// x + 2y + 4z. Who looks at leaf k = 2·axis comes from +axis.
uniform int mip_rule = 0; //! {front_to_back, mean} how eight voxels become one; mean is isotropic, front_to_back as published

vec4 directional_mean(vec4 children[8], int leaf) {
    if (mip_rule == mip_rule_mean) {
        vec4 all = vec4(0.0);
        for (int i = 0; i < 8; ++i)
            all += children[i];
        return 0.125 * all;
    }
    int depth = 1 << (leaf / 2);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        if ((i & depth) != 0) continue;
        vec4 near = (leaf & 1) == 0 ? children[i | depth] : children[i];
        vec4 far = (leaf & 1) == 0 ? children[i] : children[i | depth];
        sum += near + (1.0 - near.a) * far;
    }
    return 0.25 * sum;
}
#endif
