// One mip step of the layers: each attribute is a plain mean of four texels, since all are stored weighted by opacity.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray lrsm_finer_radiance;  //! from lrsm.radiance mip iteration - 1
uniform sampler2DArray lrsm_finer_normal;  //! from lrsm.normal mip iteration - 1
uniform sampler2DArray lrsm_finer_depth;  //! from lrsm.depth mip iteration - 1
layout(FORMAT_lrsm_coarser_radiance) writeonly uniform image2DArray lrsm_coarser_radiance;  //! from lrsm.radiance mip iteration
layout(FORMAT_lrsm_coarser_normal) writeonly uniform image2DArray lrsm_coarser_normal;  //! from lrsm.normal mip iteration
layout(FORMAT_lrsm_coarser_depth) writeonly uniform image2DArray lrsm_coarser_depth;  //! from lrsm.depth mip iteration
layout(std430) readonly buffer lrsm_summary { int summary[]; };

vec4 mean_of_four(sampler2DArray finer, ivec3 at) {
    ivec3 base = ivec3(2 * at.xy, at.z);
    return 0.25 * (texelFetch(finer, base, 0) + texelFetch(finer, base + ivec3(1, 0, 0), 0) +
                   texelFetch(finer, base + ivec3(0, 1, 0), 0) + texelFetch(finer, base + ivec3(1, 1, 0), 0));
}

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(lrsm_coarser_radiance))) || at.z >= summary[0]) return;
    imageStore(lrsm_coarser_radiance, at, mean_of_four(lrsm_finer_radiance, at));
    imageStore(lrsm_coarser_normal, at, mean_of_four(lrsm_finer_normal, at));
    imageStore(lrsm_coarser_depth, at, mean_of_four(lrsm_finer_depth, at));
}
