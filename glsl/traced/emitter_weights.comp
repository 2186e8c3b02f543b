// The weight by which each emissive triangle is drawn: its area times its mean emission's luminance, at least 2 % of what
// its material could emit, because the mean is an estimate.
#define SCENE_DRAWS
#define SCENE_MATERIALS
#define SCENE_GEOMETRY
#include "lib/scene.glsl"
#include "lib/scene_textures.glsl"
#include "lib/coverage.glsl"

layout(local_size_x = 64) in;

struct Emitter {
    uint draw, corner;
    float weight;
    uint padding;
};
layout(std430) buffer traced_emitters { Emitter emitters[]; }; //! ordered: each invocation has its own

uniform int entries;

float luminance(vec3 c) {
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= entries) return;
    Draw draw = draws[emitters[i].draw];
    Material material = materials[draw.material];
    Vertex corners[3];
    vec3 positions[3];
    for (int k = 0; k < 3; ++k) {
        corners[k] = vertices[indices[emitters[i].corner + uint(k)]];
        positions[k] = (draw.world * vec4(corners[k].position_u.xyz, 1.0)).xyz;
    }
    float area = 0.5 * length(cross(positions[1] - positions[0], positions[2] - positions[0]));
    const int k_steps = 8;
    float mean = 0.0;
    for (int y = 0; y < k_steps; ++y) {
        for (int x = 0; x < k_steps; ++x) {
            float root = sqrt((float(y) + 0.5) / float(k_steps)), along = (float(x) + 0.5) / float(k_steps);
            TrianglePoint point = triangle_point_of(corners, vec3(1.0 - root, root * (1.0 - along), root * along), 1.0);
            float there = luminance(material.emission * sample_at_point(material.emission_texture, point, 0.0).rgb);
            if (alpha_matters(material)) {
                float alpha = material.base_colour.a * point.colour.a * sample_at_point(material.base_colour_texture, point, 0.0).a;
                there *= material.alpha_cutoff < 0.0 ? alpha : (alpha >= mask_threshold(material.alpha_cutoff) ? 1.0 : 0.0);
            }
            mean += there / float(k_steps * k_steps);
        }
    }
    float weight = area * max(mean, 0.02 * luminance(material.emission));
    emitters[i].weight = weight > 0.0 && weight < 3.0e38 ? weight : 0.0;
}
