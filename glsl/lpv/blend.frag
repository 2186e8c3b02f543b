// Adds a texel's lobe to its cell, by blending.
flat in mat3x4 light;

layout(location = 0) out vec4 red;
layout(location = 1) out vec4 green;
layout(location = 2) out vec4 blue;

void main() {
    red = light[0];
    green = light[1];
    blue = light[2];
}
