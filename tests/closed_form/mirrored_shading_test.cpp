// The GPU's surface model, lights and camera (glsl/lib) and their mirrors on the CPU (passes/scene) are the same
// functions: relative 1e-4 on random inputs with α ≥ 0.02.

#include "core/low_discrepancy.h"
#include "core/paths.h"
#include "gpu/objects.h"
#include "gpu/program.h"
#include "scene/brdf.h"
#include "scene/camera_ray.h"
#include "scene/light_falloff.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_cases = 8192;
constexpr double k_tolerance = 1e-4;

struct Case {
    glm::vec4 n, v, l; // w: roughness, metallic, unused
    glm::vec4 base_colour;
    glm::vec4 x;                                                // the lit point; w: tangent of half the field of view
    glm::vec4 light_position, light_direction, light_intensity; // w: type, inner and outer cosine
    glm::vec4 target, pixel;                                    // of the camera at x
};
struct Answer {
    glm::vec4 diffuse, specular, irradiance, to_light, ray;
};

const char* const k_shader = R"(#version 460
#include "lib/brdf.glsl"
#include "lib/camera.glsl"
#include "lib/light.glsl"
layout(local_size_x = 64) in;
struct Case { vec4 n, v, l, base_colour, x, light_position, light_direction, light_intensity, target, pixel; };
struct Answer { vec4 diffuse, specular, irradiance, to_light, ray; };
layout(std430) readonly buffer test_cases { Case cases[]; };
layout(std430) writeonly buffer test_answers { Answer answers[]; };
void main() {
    Case c = cases[gl_GlobalInvocationID.x];
    Answer a;
    a.diffuse = vec4(brdf_diffuse(c.base_colour.rgb, c.v.w), 0.0);
    a.specular = vec4(brdf_specular(c.n.xyz, c.v.xyz, c.l.xyz, c.base_colour.rgb, c.v.w, c.n.w), 0.0);
    Light light;
    light.position = c.light_position.xyz;
    light.type = uint(c.light_position.w);
    light.direction = c.light_direction.xyz;
    light.inner_cone_cos = c.light_direction.w;
    light.intensity = c.light_intensity.rgb;
    light.outer_cone_cos = c.light_intensity.w;
    vec3 l;
    a.irradiance = vec4(light_irradiance(light, c.x.xyz, l), 0.0);
    a.to_light = vec4(l, 0.0);
    mat3 basis = camera_basis(c.x.xyz, c.target.xyz, vec3(0.0, 1.0, 0.0));
    a.ray = vec4(camera_ray(basis, c.x.w, c.pixel.zw, c.pixel.xy), 0.0);
    answers[gl_GlobalInvocationID.x] = a;
}
)";

glm::vec3 unit_vector(PixelSampler& random) {
    const glm::vec2 u = random.next_pair();
    const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
    return glm::normalize(glm::vec3(r * std::cos(6.2831853f * u.y), r * std::sin(6.2831853f * u.y), z));
}

glm::vec3 above(const glm::vec3& n, PixelSampler& random) {
    // Not at the very horizon, where n·l itself has no relative precision.
    while (true) {
        const glm::vec3 d = unit_vector(random);
        if (glm::dot(n, d) > 0.01f) return d;
    }
}

std::vector<Case> random_cases() {
    std::vector<Case> cases(k_cases);
    for (int i = 0; i < k_cases; ++i) {
        PixelSampler random(17, uint32_t(i), false);
        Case& c = cases[size_t(i)];
        const glm::vec3 n = unit_vector(random), v = above(n, random);
        glm::vec3 l = above(n, random);
        const float smallest_roughness = std::sqrt(0.02f);
        const float roughness = smallest_roughness + (1 - smallest_roughness) * random.next() * random.next();
        // Every second direction lies in the lobe's peak, where cancellation would show.
        if (i % 2) {
            const glm::vec3 near =
                glm::normalize(glm::reflect(-v, n) + 0.3f * roughness * roughness * unit_vector(random));
            if (glm::dot(n, near) > 0.01f) l = near;
        }
        c.n = glm::vec4(n, roughness);
        c.v = glm::vec4(v, random.next());
        c.l = glm::vec4(l, 0);
        c.base_colour = glm::vec4(random.next(), random.next(), random.next(), 1);
        c.x = glm::vec4(10.0f * glm::vec3(random.next(), random.next(), random.next()), 0.1f + random.next());
        const glm::vec3 position = glm::vec3(c.x) + (0.1f + 10 * random.next()) * unit_vector(random);
        const float type = float(i % 3);
        const float inner = 0.5f * random.next(), outer = inner + 0.1f + random.next();
        // Spots look toward the point, well inside of their rim.
        const glm::vec3 axis =
            glm::normalize(glm::normalize(glm::vec3(c.x) - position) + 0.6f * std::sin(outer) * unit_vector(random));
        c.light_position = glm::vec4(position, type);
        c.light_direction = glm::vec4(axis, std::cos(inner));
        c.light_intensity = glm::vec4(100.0f * random.next(), 20, 3, std::cos(outer));
        c.target = glm::vec4(glm::vec3(c.x) + unit_vector(random), 0);
        c.pixel = {1280 * random.next(), 720 * random.next(), 1280, 720};
    }
    return cases;
}

Answer on_the_cpu(const Case& c) {
    Answer a{};
    const glm::vec3 base(c.base_colour);
    a.diffuse = glm::vec4(brdf_diffuse(base, c.v.w), 0);
    a.specular = glm::vec4(brdf_specular(glm::vec3(c.n), glm::vec3(c.v), glm::vec3(c.l), base, c.v.w, c.n.w), 0);
    Light light;
    light.type = LightType(uint32_t(c.light_position.w));
    light.position = glm::vec3(c.light_position);
    light.direction = glm::vec3(c.light_direction);
    light.intensity = glm::vec3(c.light_intensity);
    light.inner_cone = std::acos(c.light_direction.w);
    light.outer_cone = std::acos(c.light_intensity.w);
    glm::vec3 l;
    a.irradiance = glm::vec4(light_irradiance(light, glm::vec3(c.x), l), 0);
    a.to_light = glm::vec4(l, 0);
    const glm::mat3 basis = camera_basis(glm::vec3(c.x), glm::vec3(c.target), {0, 1, 0});
    a.ray = glm::vec4(camera_ray(basis, c.x.w, {c.pixel.z, c.pixel.w}, {c.pixel.x, c.pixel.y}), 0);
    return a;
}

/// The largest difference, relative to the vector's own size.
double difference(const glm::vec4& a, const glm::vec4& b) {
    const double size = std::max(double(glm::length(b)), 1e-12);
    return glm::length(a - b) / size;
}

class MirroredShading : public GpuTest {};

} // namespace

TEST_F(MirroredShading, GpuAndCpuAgree) {
    TempFolder folder;
    folder.write("mirrored.comp", k_shader);
    std::filesystem::copy(glsl_folder() / "lib", folder.path() / "lib", std::filesystem::copy_options::recursive);
    Program program("mirrored", {"mirrored.comp"}, folder.path());
    program.scan({}, {});
    ASSERT_TRUE(program.build({})) << (program.errors().empty() ? "" : program.errors()[0].text());

    const std::vector<Case> cases = random_cases();
    const Buffer input(cases.size() * sizeof(Case), cases.data(), "test.cases");
    const Buffer output(cases.size() * sizeof(Answer), nullptr, "test.answers");
    for (const BlockInfo& block : program.interface().storage_blocks) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block.binding,
                         block.name == "test_cases" ? input.id() : output.id());
    }
    glUseProgram(program.id());
    glDispatchCompute(k_cases / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<Answer> answers = output.read_all<Answer>();
    glUseProgram(0);

    double worst[5] = {0, 0, 0, 0, 0};
    int lit = 0;
    for (int i = 0; i < k_cases; ++i) {
        const Case& c = cases[size_t(i)];
        const Answer &got = answers[size_t(i)], expected = on_the_cpu(c);
        worst[0] = std::max(worst[0], difference(got.diffuse, expected.diffuse));
        worst[1] = std::max(worst[1], difference(got.specular, expected.specular));
        // The last hundredth of a spot's falloff is a difference of nearly equal cosines.
        const float reach = glm::length(glm::vec3(c.light_intensity)) /
                            glm::dot(glm::vec3(c.light_position - c.x), glm::vec3(c.light_position - c.x));
        if (c.light_position.w == 2 || glm::length(expected.irradiance) > 0.01f * reach) {
            worst[2] = std::max(worst[2], difference(got.irradiance, expected.irradiance));
            ++lit;
        }
        worst[3] = std::max(worst[3], difference(got.to_light, expected.to_light));
        worst[4] = std::max(worst[4], difference(got.ray, expected.ray));
    }
    EXPECT_GT(lit, k_cases * 3 / 4);
    const char* const names[5] = {"diffuse lobe", "microfacet lobe", "irradiance", "direction to light", "camera ray"};
    for (int i = 0; i < 5; ++i) {
        EXPECT_LT(worst[i], k_tolerance) << names[i];
        fmt::print("    {:<20} differs by {:.1e} at most\n", names[i], worst[i]);
    }
}
