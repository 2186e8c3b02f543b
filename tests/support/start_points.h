#pragma once
// A shader for tests of gathers: their points and normals follow from where their texels start.

namespace bounce {

/// Where the texels of a gather start: position, and 1 in a where there is a surface.
inline constexpr const char* k_start_shader = R"(#include "surface/start.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_test_start) writeonly uniform image2D test_start;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    StartPoint start;
    if (any(greaterThanEqual(pixel, resolution))) return;
    bool there = start_at(pixel, start);
    imageStore(test_start, pixel, there ? vec4(start.position, 1.0) : vec4(0.0));
}
)";

} // namespace bounce
