#ifndef DVS_RUNNING_AVERAGE_GLSL
#define DVS_RUNNING_AVERAGE_GLSL
// A running mean in 32 bits, three values of eight and a count (Crassin & Green, "Octree-based sparse voxelization using the
// GPU hardware rasterizer", 2012): read, blend, and swap in unless another fragment came between. The mean is rounded at
// each step, so the result depends on the order; the count stops at 255. GLSL cannot pass images that are written as
// arguments on every driver, hence a macro.
uint blend_packed(uint old, vec3 value) {
    float count = float(old >> 24);
    vec3 mean = vec3(old & 255u, (old >> 8) & 255u, (old >> 16) & 255u) / 255.0;
    mean = (mean * count + clamp(value, 0.0, 1.0)) / (count + 1.0);
    uvec3 bits = uvec3(round(mean * 255.0));
    return bits.r | (bits.g << 8) | (bits.b << 16) | (min(uint(count) + 1u, 255u) << 24);
}

#define RUNNING_AVERAGE(name, image)                                              \
    void name(ivec3 voxel, vec3 value) {                                          \
        uint expected = 0u, next = blend_packed(0u, value);                       \
        for (int i = 0; i < 1024; ++i) {                                          \
            uint found = imageAtomicCompSwap(image, voxel, expected, next);       \
            if (found == expected) break;                                         \
            expected = found;                                                     \
            next = blend_packed(found, value);                                    \
        }                                                                         \
    }
RUNNING_AVERAGE(running_average_albedo, voxels_packed_albedo)
RUNNING_AVERAGE(running_average_normal, voxels_packed_normal)
RUNNING_AVERAGE(running_average_emission, voxels_packed_emission)

#endif
