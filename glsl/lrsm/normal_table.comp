// The standard normal distribution's table (LRSM, section 5): Φ(x) at 256 equally spaced x in [−4, 4], by Simpson's rule
// over the density.
layout(local_size_x = 64) in;

layout(FORMAT_lrsm_normal_table) writeonly uniform image2D lrsm_normal_table;

float density(float x) {
    return 0.3989422804 * exp(-0.5 * x * x);
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(lrsm_normal_table).x) return;
    float x = float(i) / float(imageSize(lrsm_normal_table).x - 1) * 8.0 - 4.0;
    const int k_steps = 64;
    float h = x / float(k_steps), sum = density(0.0) + density(x);
    for (int k = 1; k < k_steps; ++k)
        sum += (k % 2 == 1 ? 4.0 : 2.0) * density(float(k) * h);
    imageStore(lrsm_normal_table, ivec2(i, 0), vec4(0.5 + sum * h / 3.0));
}
