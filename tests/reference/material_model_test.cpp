// The material models in the tracer: against quadrature of the lobes, and the white furnace.

#include "core/low_discrepancy.h"
#include "reference/render.h"
#include "reference/sampling.h"
#include "scene/lobe_albedo.h"
#include "scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace bounce;
using namespace bounce::test;

namespace {

double mean(const Image& image) {
    return image_mean(image, Mask(image.width, image.height));
}

constexpr MaterialModel k_models[] = {MaterialModel::plain, MaterialModel::gltf, MaterialModel::appendix_b};

glm::vec3 direction(float cosine, float angle) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// What both lobes send toward `cosine` of a sky of radiance 1, by drawing each lobe's own directions.
glm::dvec3 sky_albedo(MaterialModel model, float cosine, const glm::vec3& base, float metallic, float roughness) {
    const glm::vec3 n(0, 0, 1), v = direction(cosine, 0);
    const float alpha = brdf_alpha(roughness);
    glm::dvec3 sum(0);
    const uint32_t count = 1 << 15;
    for (uint32_t i = 0; i < count; ++i) {
        PixelSampler sampler(9, i, true);
        const glm::vec3 even = cosine_hemisphere(sampler.next_pair());
        sum += glm::dvec3(k_pi * diffuse_lobe(model, n, v, even, base, metallic, roughness));
        const glm::vec3 h = visible_normal(v, alpha, sampler.next_pair()), l = 2 * glm::dot(v, h) * h - v;
        if (l.z <= 0) continue;
        const float density = visible_normal_density(ggx_density(n, glm::normalize(v + l), alpha), cosine, alpha);
        sum += glm::dvec3(brdf_specular(n, v, l, base, metallic, roughness) * (l.z / density));
    }
    return sum / double(count);
}

/// A wide floor seen under `cosine`.
SceneMaker floor_at(float cosine, const glm::vec3& base, float metallic, float roughness, MaterialModel model) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.shot.material_model = model;
    maker.shot.width = maker.shot.height = 8;
    maker.quad({-60, 0, -60}, {0, 0, 120}, {120, 0, 0}, maker.material(base, glm::vec3(0), metallic, roughness));
    const glm::vec3 v = direction(cosine, 0);
    maker.camera(5.0f * glm::vec3(v.x, v.z, v.y), {0, 0, 0}, 0.05f, {0, 1, 0.001f});
    return maker;
}

} // namespace

TEST(MaterialModel, TheTracerSumsTheLobes) {
    const glm::vec3 base(0.9f, 0.5f, 0.2f);
    for (MaterialModel model : k_models) {
        for (float metallic : {0.0f, 0.4f, 1.0f}) {
            for (float roughness : {0.15f, 0.5f, 1.0f}) {
                const float cosine = 0.35f;
                SceneMaker maker = floor_at(cosine, base, metallic, roughness, model);
                maker.light(LightType::point, {-1, 2, -1}, {0, -1, 0}, 5);
                maker.shot.environment.radiance = glm::vec3(0.6f);
                ReferenceRender render(maker.shot, {.bounces = 0});
                render.render_to(256);
                const glm::vec3 d = direction(cosine, 0), n(0, 1, 0), v(d.x, d.z, d.y);
                const glm::vec3 l = glm::normalize(glm::vec3(-1, 2, -1));
                const glm::vec3 f = diffuse_lobe(model, n, v, l, base, metallic, roughness) +
                                    brdf_specular(n, v, l, base, metallic, roughness);
                EXPECT_NEAR(mean(render.part("out.direct")) / (5.0 / 6 * l.y * (f.r + f.g + f.b) / 3), 1, 3e-3)
                    << int(model) << " " << metallic << " " << roughness;
                const glm::dvec3 sky = sky_albedo(model, cosine, base, metallic, roughness);
                EXPECT_NEAR(mean(render.part("out.environment")) / (0.6 * (sky.r + sky.g + sky.b) / 3), 1, 4e-3)
                    << int(model) << " " << metallic << " " << roughness;
            }
        }
    }
}

// Under a sky of radiance 1 nothing shines brighter than it.
TEST(MaterialModel, WhiteFurnace) {
    double most[3] = {0, 0, 0};
    for (MaterialModel model : k_models) {
        for (float metallic : {0.0f, 0.5f, 1.0f}) {
            for (float roughness : {0.0f, 0.3f, 1.0f}) {
                for (float cosine : {0.05f, 0.2f, 0.5f, 0.99f}) {
                    for (const glm::vec3& base : {glm::vec3(1), glm::vec3(0.8f, 0.4f, 0)}) {
                        SceneMaker maker = floor_at(cosine, base, metallic, roughness, model);
                        maker.shot.environment.radiance = glm::vec3(1);
                        ReferenceRender render(maker.shot, {.bounces = 0});
                        render.render_to(64);
                        const Image sky = render.part("out.environment");
                        double sum = 0;
                        for (size_t i = 0; i < sky.pixels.size(); i += size_t(sky.channels))
                            sum += double(sky.pixels[i]);
                        sum /= double(sky.pixels.size() / size_t(sky.channels));
                        most[int(model)] = std::max(most[int(model)], sum);
                        if (model != MaterialModel::gltf) continue;
                        EXPECT_LT(sum, 1.006) << "metallic " << metallic << ", roughness " << roughness << ", cosine "
                                              << cosine << ", base colour " << base.r;
                    }
                }
            }
        }
    }
    EXPECT_GT(most[0], 1.5);
    EXPECT_GT(most[2], 1.5);
    fmt::print("    the brightest floor under a sky of radiance 1: plain {:.3f}, gltf {:.3f}, appendix_b {:.3f}\n",
               most[0], most[1], most[2]);
}

// In a closed white box that shines evenly, each later order is no brighter than the one before.
TEST(MaterialModel, ClosedWhiteFurnace) {
    for (float metallic : {0.0f, 0.5f}) {
        for (float roughness : {0.1f, 0.6f}) {
            double radiance[3];
            for (int bounces : {0, 1, 2}) {
                SceneMaker maker;
                maker.shot.diffuse_only = false;
                maker.box({-1, -1, -1}, {1, 1, 1}, maker.material(glm::vec3(1), glm::vec3(1), metallic, roughness));
                maker.camera({0, 0, 0}, {1, 0.4f, 0.2f}, 80);
                ReferenceRender render(maker.shot, {.bounces = bounces});
                render.render_to(64);
                radiance[bounces] = mean(render.part("out.radiance"));
            }
            EXPECT_LT(radiance[0], 2.005);
            EXPECT_LT(radiance[1] - radiance[0], (radiance[0] - 1) * 1.005);
            EXPECT_LT(radiance[2] - radiance[1], (radiance[1] - radiance[0]) * 1.005);
        }
    }
}

TEST(MaterialModel, LambertWhereTheShotIsDiffuseOnly) {
    for (MaterialModel model : k_models) {
        SceneMaker maker = floor_at(0.3f, glm::vec3(0.5f), 0, 0.3f, model);
        maker.shot.environment.radiance = glm::vec3(1);
        maker.shot.diffuse_only = true;
        ReferenceRender lambert(maker.shot, {.bounces = 0});
        lambert.render_to(16);
        EXPECT_NEAR(mean(lambert.part("out.environment")), 0.5, 1e-5);
        // The transport of a graph that has no microfacet lobe leaves the model's own diffuse lobe.
        maker.shot.diffuse_only = false;
        ReferenceRender lobe(maker.shot, {.bounces = 0, .diffuse_only = true});
        lobe.render_to(64);
        const double expected = double(diffuse_albedo(model, glm::vec3(0.5f), 0, 0.3f, 0.3f).r);
        EXPECT_NEAR(mean(lobe.part("out.environment")), expected, 2e-3) << int(model);
    }
}

TEST(MaterialModel, IsPartOfTheKey) {
    std::string keys[3];
    for (MaterialModel model : k_models) {
        SceneMaker maker = floor_at(0.3f, glm::vec3(0.5f), 0, 0.3f, model);
        keys[int(model)] = ReferenceRender(maker.shot, {}).key();
        maker.shot.diffuse_only = true;
        const std::string lambert = ReferenceRender(maker.shot, {}).key();
        maker.shot.material_model = MaterialModel::plain;
        EXPECT_EQ(ReferenceRender(maker.shot, {}).key(), lambert) << "Lambert is the same in each";
    }
    EXPECT_NE(keys[0], keys[1]);
    EXPECT_NE(keys[1], keys[2]);
}

// A perfect mirror and the roughest surface: nothing that is not finite, in any model.
TEST(MaterialModel, EndsOfRoughness) {
    for (MaterialModel model : k_models) {
        for (float roughness : {0.0f, 1.0f}) {
            for (float metallic : {0.0f, 1.0f}) {
                for (float base : {0.0f, 0.04f, 1.0f}) {
                    SceneMaker maker;
                    maker.shot.diffuse_only = false;
                    maker.shot.material_model = model;
                    maker.sphere(1, 8, maker.material(glm::vec3(base), glm::vec3(0), metallic, roughness));
                    maker.quad({-3, -1, -3}, {0, 0, 6}, {6, 0, 0},
                               maker.material(glm::vec3(base), glm::vec3(0.1f), metallic, roughness));
                    maker.camera({0, 1, 4}, {0, 0, 0}, 40);
                    maker.light(LightType::point, {1, 2, 1}, {0, -1, 0}, 3);
                    maker.shot.environment.radiance = glm::vec3(0.3f);
                    ReferenceRender render(maker.shot, {.bounces = 4});
                    render.render_to(4);
                    for (float value : render.part("out.radiance").pixels)
                        ASSERT_TRUE(std::isfinite(value) && value >= 0);
                }
            }
        }
    }
}
