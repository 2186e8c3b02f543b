// Progressive rendering: the mean of a picture over the frames, in place (LDM, section 6: views that turn from frame to
// frame average out). The graph clears the mean when anything but the passing of frames changes the picture; what moves by
// itself lags behind by up to `max_frames`.

layout(local_size_x = 8, local_size_y = 8) in;

// this frame's; becomes the mean
layout(FORMAT_accumulate_picture) uniform image2D accumulate_picture; //! ordered: each has its own pixel
// a = frames so far; kept from frame to frame
layout(FORMAT_accumulate_mean) uniform image2D accumulate_mean;       //! ordered: each has its own pixel

uniform int max_frames = 256; //! [1, 65536] frames that the mean reaches back

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(accumulate_picture)))) return;
    vec4 mean = imageLoad(accumulate_mean, texel);
    float frames = min(mean.a + 1.0, float(max_frames));
    mean = vec4(mix(mean.rgb, imageLoad(accumulate_picture, texel).rgb, 1.0 / frames), frames);
    imageStore(accumulate_mean, texel, mean);
    imageStore(accumulate_picture, texel, vec4(mean.rgb, 1.0));
}
