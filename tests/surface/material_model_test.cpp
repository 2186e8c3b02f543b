// The material models on the GPU: the same functions as on the CPU, and a white furnace of lights.

#include "core/low_discrepancy.h"
#include "core/paths.h"
#include "gpu/objects.h"
#include "gpu/program.h"
#include "gpu_scene/frame_constants.h"
#include "scene/lobe_albedo.h"
#include "support/gpu_context.h"
#include "support/scene_runner.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_cases = 4096;

struct Case {
    glm::vec4 n, v, l, base_colour; // w: roughness, metallic, cosine, unused
};
struct Answer {
    glm::vec4 lobes, albedo, microfacet, limit; // w of the first: share; of the second: mean share
};

const char* const k_shader = R"(#version 460
#include "lib/material_model.glsl"
layout(local_size_x = 64) in;
struct Case { vec4 n, v, l, base_colour; };
struct Answer { vec4 lobes, albedo, microfacet, limit; };
layout(std430) readonly buffer test_cases { Case cases[]; };
layout(std430) writeonly buffer test_answers { Answer answers[]; };
void main() {
    Case c = cases[gl_GlobalInvocationID.x];
    vec3 base = c.base_colour.rgb, f0 = brdf_f0(base, c.v.w);
    Answer a;
    a.lobes = vec4(surface_lobes(c.n.xyz, c.v.xyz, c.l.xyz, base, c.v.w, c.n.w), diffuse_share(c.l.w));
    a.albedo = vec4(diffuse_albedo(base, c.v.w, c.n.w, c.l.w), mean_diffuse_share());
    a.microfacet = vec4(microfacet_albedo(f0, c.n.w, c.l.w), 0.0);
    a.limit = vec4(diffuse_limit(base, f0, c.n.w, c.l.w), 0.0);
    answers[gl_GlobalInvocationID.x] = a;
}
)";

glm::vec3 above(const glm::vec3& n, PixelSampler& random) {
    while (true) {
        const glm::vec2 u = random.next_pair();
        const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
        const glm::vec3 d(r * std::cos(6.2831853f * u.y), r * std::sin(6.2831853f * u.y), z);
        if (glm::dot(n, d) > 0.01f) return glm::normalize(d);
    }
}

std::vector<Case> random_cases() {
    std::vector<Case> cases(k_cases);
    for (int i = 0; i < k_cases; ++i) {
        PixelSampler random(23, uint32_t(i), false);
        Case& c = cases[size_t(i)];
        const glm::vec3 n = above({0, 0, 1}, random);
        c.n = glm::vec4(n, i % 8 ? std::sqrt(0.02f) + 0.85f * random.next() : 1.0f);
        c.v = glm::vec4(above(n, random), i % 3 ? random.next() : float(i % 2));
        c.l = glm::vec4(above(n, random), random.next());
        c.base_colour = glm::vec4(random.next(), random.next(), 1, 1);
    }
    return cases;
}

Answer on_the_cpu(const Case& c, MaterialModel model, bool diffuse_only) {
    const glm::vec3 n(c.n), v(c.v), l(c.l), base(c.base_colour), f0 = brdf_f0(base, c.v.w);
    if (diffuse_only) model = MaterialModel::plain;
    const bool lambert = model == MaterialModel::plain;
    glm::vec3 lobes = diffuse_lobe(model, n, v, l, base, c.v.w, c.n.w);
    if (!diffuse_only) lobes += brdf_specular(n, v, l, base, c.v.w, c.n.w);
    return {glm::vec4(lobes, lambert ? 1 : fresnel_diffuse_albedo(c.l.w)),
            glm::vec4(diffuse_albedo(model, base, c.v.w, c.n.w, c.l.w), lambert ? 1 : k_mean_fresnel_diffuse_albedo),
            glm::vec4(microfacet_albedo(f0, c.n.w, c.l.w), 0), glm::vec4(diffuse_limit(base, f0, c.n.w, c.l.w), 0)};
}

double difference(const glm::vec4& a, const glm::vec4& b) {
    return double(glm::length(a - b)) / std::max(double(glm::length(b)), 1e-12);
}

class MaterialModels : public SceneGraphTest {};

} // namespace

TEST_F(MaterialModels, GpuAndCpuAgree) {
    TempFolder folder;
    folder.write("models.comp", k_shader);
    std::filesystem::copy(glsl_folder() / "lib", folder.path() / "lib", std::filesystem::copy_options::recursive);
    Program program("models", {"models.comp"}, folder.path());
    program.scan({}, {});
    ASSERT_TRUE(program.build({})) << (program.errors().empty() ? "" : program.errors()[0].text());
    GpuTexture table({TextureKind::texture_2d, GL_RG32F, {32, 32, 1}, 1}, "table");
    glTextureSubImage2D(table.id(), 0, 0, 0, 32, 32, GL_RG, GL_FLOAT, lobe_albedo_table().entries.data());
    for (const OpaqueInfo& sampler : program.interface().samplers) {
        EXPECT_EQ(sampler.name, "scene_lobe_albedo");
        glBindTextureUnit(GLuint(sampler.unit), table.id());
        glBindSampler(GLuint(sampler.unit), 0);
    }
    const std::vector<Case> cases = random_cases();
    const Buffer input(cases.size() * sizeof(Case), cases.data(), "test.cases");
    const Buffer output(cases.size() * sizeof(Answer), nullptr, "test.answers");
    for (const BlockInfo& block : program.interface().storage_blocks) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block.binding,
                         block.name == "test_cases" ? input.id() : output.id());
    }
    for (bool diffuse_only : {false, true}) {
        for (MaterialModel model : {MaterialModel::plain, MaterialModel::gltf, MaterialModel::appendix_b}) {
            for (const UniformInfo& uniform : program.interface().uniforms) {
                if (uniform.name == "material_model")
                    glProgramUniform1i(program.id(), uniform.location, int(model));
                else if (uniform.name == "diffuse_only")
                    glProgramUniform1i(program.id(), uniform.location, diffuse_only);
                else
                    FAIL() << "a constant of the frame that this test does not set: " << uniform.name;
            }
            glUseProgram(program.id());
            glDispatchCompute(k_cases / 64, 1, 1);
            glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
            const std::vector<Answer> answers = output.read_all<Answer>();
            glUseProgram(0);
            double worst = 0;
            for (int i = 0; i < k_cases; ++i) {
                const Answer &got = answers[size_t(i)], expected = on_the_cpu(cases[size_t(i)], model, diffuse_only);
                worst =
                    std::max({worst, difference(got.lobes, expected.lobes), difference(got.albedo, expected.albedo),
                              difference(got.microfacet, expected.microfacet), difference(got.limit, expected.limit)});
            }
            EXPECT_LT(worst, 2e-4) << int(model) << " " << diffuse_only;
            fmt::print("    {}{} differs by {:.1e} at most\n", k_material_models[size_t(model)],
                       diffuse_only ? ", diffuse only," : "", worst);
        }
    }
}

// 256 suns, evenly over the hemisphere by their cosine: a sky of radiance 1, for lobes that are not narrow. Nothing
// shines brighter than it, and the tracer's sum of the same lobes is met.
TEST_F(MaterialModels, WhiteFurnaceOfLights) {
    constexpr int k_suns = 256;
    std::vector<Light> suns;
    for (int i = 0; i < k_suns; ++i) {
        const float cosine = std::sqrt((float(i) + 0.5f) / k_suns), sine = std::sqrt(1 - cosine * cosine);
        const float angle = 2.3999632f * float(i);
        suns.push_back(directional_light({sine * std::cos(angle), -cosine, sine * std::sin(angle)},
                                         glm::vec3(k_pi / (k_suns * cosine))));
    }
    const char* const graph =
        R"("resources":{"out.direct":{"format":"rgba32f"}},"passes":[{"type":"gbuffer"},)"
        R"({"id":"direct","type":"compute","shader":"surface/direct.comp","params":{"shadows":false}}])";
    double most = 0;
    for (float metallic : {0.0f, 0.5f, 1.0f}) {
        for (float roughness : {0.8f, 1.0f}) {
            for (const glm::vec3& base : {glm::vec3(1), glm::vec3(0.8f, 0.4f, 0.1f)}) {
                MadeScene made;
                made.quad({-90, 0, 90}, {90, 0, 90}, {90, 0, -90}, {-90, 0, -90}, base);
                made.material().roughness = roughness;
                made.material().metallic = metallic;
                for (float cosine : {0.2f, 0.5f, 0.95f}) {
                    for (MaterialModel model : {MaterialModel::gltf, MaterialModel::appendix_b}) {
                        SceneRunner run(made.scene, suns, graph_file(graph), {}, {2, 2});
                        run.diffuse_only = 0;
                        run.material_model = int(model);
                        run.camera.position = 5.0f * glm::vec3(std::sqrt(1 - cosine * cosine), cosine, 0);
                        run.camera.target = glm::vec3(0);
                        run.camera.vfov = 0.002f;
                        run.frame();
                        const std::vector<float> got = run.read("out.direct");
                        glm::vec3 expected(0);
                        const glm::vec3 n(0, 1, 0), v = glm::normalize(run.camera.position);
                        for (const Light& sun : suns)
                            expected += (diffuse_lobe(model, n, v, -sun.direction, base, metallic, roughness) +
                                         brdf_specular(n, v, -sun.direction, base, metallic, roughness)) *
                                        (k_pi / k_suns);
                        EXPECT_NEAR(got[0], expected.r, 3e-3f * expected.r);
                        if (model != MaterialModel::gltf) continue;
                        EXPECT_LT(got[0], 1.02f) << metallic << " " << roughness << " " << cosine;
                        most = std::max(most, double(got[0]));
                    }
                }
            }
        }
    }
    fmt::print("    the brightest surface under 256 suns that make a sky of radiance 1: {:.4f}\n", most);
}
