// The material models' lobes: closed forms and tables against quadrature, reciprocity, and the white furnace.

#include "scene/lobe_albedo.h"

#include "core/error.h"
#include "core/low_discrepancy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bounce {
namespace {

const glm::vec3 k_up(0, 0, 1);

glm::vec3 at_cosine(float cosine, float angle = 0) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// ∫ f(l)·⟨n·l⟩ dl of the diffuse lobe, by a grid of equal shares of ⟨n·l⟩ dl.
glm::vec3 diffuse_by_quadrature(MaterialModel model, float cosine, const glm::vec3& base, float metallic,
                                float roughness, int steps = 96) {
    glm::dvec3 sum(0);
    const glm::vec3 v = at_cosine(cosine);
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const float c = std::sqrt((float(i) + 0.5f) / float(steps));
            const glm::vec3 l = at_cosine(c, k_pi * (float(j) + 0.5f) / float(steps));
            sum += glm::dvec3(diffuse_lobe(model, k_up, v, l, base, metallic, roughness));
        }
    }
    return glm::vec3(sum * double(k_pi) / double(steps * steps));
}

/// ∫ D·V·F·⟨n·l⟩ dl as (a, b) of F0·a + b: a lobe of F0 = 0 is b, one of F0 = 1 is a + b. Drawn where the lobe is not
/// wide, over a far denser grid than the table's; else summed over directions.
glm::vec2 microfacet_by_quadrature(float cosine, float roughness) {
    const float alpha = brdf_alpha(roughness);
    const glm::vec3 v = at_cosine(cosine);
    double a = 0, b = 0;
    const int steps = roughness < 0.35f ? 600 : 500;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / float(steps);
            glm::vec3 l;
            double weight;
            if (roughness < 0.35f) {
                const glm::vec3 h = visible_normal(v, alpha, u);
                l = 2 * glm::dot(v, h) * h - v;
                if (l.z <= 0) continue;
                weight = double(smith_visibility(l.z, cosine, alpha) * l.z / visible_normal_density(1, cosine, alpha));
            } else {
                l = at_cosine(u.x * u.x, k_pi * (1 - u.y * u.y)); // denser at the horizon and ahead
                const float d = ggx_density(k_up, glm::normalize(v + l), alpha);
                weight = double(d * smith_visibility(l.z, cosine, alpha) * l.z * 2 * u.x * 4 * k_pi * u.y);
            }
            const double fresnel = double(schlick_weight(v, glm::normalize(v + l)));
            a += weight * (1 - fresnel);
            b += weight * fresnel;
        }
    }
    return glm::vec2(a, b) / float(steps * steps);
}

} // namespace

TEST(LobeAlbedo, TheTableIsTheIntegral) {
    double worst = 0;
    for (float roughness : {0.0f, 0.05f, 0.13f, 0.3f, 0.44f, 0.5f, 0.77f, 1.0f}) {
        for (float cosine : {0.02f, 0.11f, 0.3f, 0.62f, 0.97f, 1.0f}) {
            const glm::vec2 table = lobe_albedo_table().at(cosine, roughness);
            const glm::vec2 exact = microfacet_by_quadrature(cosine, roughness);
            const double off = double(glm::max(std::abs(table.x - exact.x), std::abs(table.y - exact.y)));
            worst = std::max(worst, off);
            EXPECT_LT(off, cosine < 0.1f ? 0.012 : 3e-3) << "cosine " << cosine << ", roughness " << roughness;
        }
    }
    fmt::print("    the table of the microfacet lobe's albedo is off by {:.1e} at most\n", worst);
}

TEST(LobeAlbedo, ThePolynomialIsTheIntegral) {
    double mean = 0;
    for (int i = 0; i < 64; ++i) {
        const float cosine = std::sqrt((float(i) + 0.5f) / 64);
        const float exact = diffuse_by_quadrature(MaterialModel::appendix_b, cosine, glm::vec3(1), 0, 0.5f, 200).x;
        EXPECT_NEAR(fresnel_diffuse_albedo(cosine), exact, 3e-5f) << cosine;
        mean += double(exact) / 64;
    }
    EXPECT_NEAR(k_mean_fresnel_diffuse_albedo, mean, 3e-5);
}

TEST(LobeAlbedo, LobesAreReciprocal) {
    for (MaterialModel model : {MaterialModel::plain, MaterialModel::gltf, MaterialModel::appendix_b}) {
        for (uint32_t i = 0; i < 2000; ++i) {
            PixelSampler random(5, i, false);
            const glm::vec3 v = at_cosine(0.01f + 0.99f * random.next(), 6.28f * random.next());
            const glm::vec3 l = at_cosine(0.01f + 0.99f * random.next(), 6.28f * random.next());
            const glm::vec3 base(random.next(), random.next(), 1);
            const float metallic = random.next(), roughness = random.next();
            const glm::vec3 forth = diffuse_lobe(model, k_up, v, l, base, metallic, roughness);
            const glm::vec3 back = diffuse_lobe(model, k_up, l, v, base, metallic, roughness);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(forth[c], back[c], 1e-5f * (1e-3f + forth[c]));
        }
    }
}

// No material sends out more than comes in, from any side. The plain sum and appendix B's do: how much is printed.
TEST(LobeAlbedo, WhiteFurnace) {
    double most[3] = {0, 0, 0};
    for (float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
        for (float cosine : {0.03f, 0.1f, 0.25f, 0.5f, 1.0f}) {
            const glm::vec2 ab = microfacet_by_quadrature(cosine, roughness);
            for (float metallic : {0.0f, 0.3f, 0.7f, 1.0f}) {
                for (const glm::vec3& base : {glm::vec3(1), glm::vec3(0.8f, 0.5f, 0.1f), glm::vec3(0)}) {
                    for (MaterialModel model : {MaterialModel::plain, MaterialModel::gltf, MaterialModel::appendix_b}) {
                        const glm::vec3 sent = diffuse_by_quadrature(model, cosine, base, metallic, roughness, 48) +
                                               brdf_f0(base, metallic) * ab.x + ab.y;
                        const double brightest = double(std::max(sent.r, std::max(sent.g, sent.b)));
                        most[int(model)] = std::max(most[int(model)], brightest);
                        if (model != MaterialModel::gltf) continue;
                        EXPECT_LT(brightest, 1.003) << "roughness " << roughness << ", cosine " << cosine
                                                    << ", metallic " << metallic << ", base colour " << base.r;
                    }
                }
            }
        }
    }
    EXPECT_GT(most[int(MaterialModel::plain)], 1.5);
    EXPECT_GT(most[int(MaterialModel::appendix_b)], 1.5);
    fmt::print("    the most that is sent out of what comes in: plain {:.3f}, gltf {:.3f}, appendix_b {:.3f}\n",
               most[0], most[1], most[2]);
}

// Where appendix B keeps to what comes in, the limit leaves it alone.
TEST(LobeAlbedo, TheLimitOnlyActsWhereEnergyWouldBeMade) {
    for (float roughness : {0.5f, 0.7f, 1.0f}) {
        for (float cosine : {0.02f, 0.2f, 0.7f, 1.0f}) {
            const glm::vec3 limit = diffuse_limit(glm::vec3(0.8f), glm::vec3(k_dielectric_f0), roughness, cosine);
            EXPECT_EQ(limit.r, 1) << roughness << " " << cosine;
        }
    }
    // The mean change of the light between surfaces, over all directions of view and of light.
    auto change = [](float albedo, float roughness) {
        double with = 0, without = 0;
        for (int i = 0; i < 24; ++i) {
            const float cosine = std::sqrt((float(i) + 0.5f) / 24);
            auto sum = [&](MaterialModel model) {
                return double(diffuse_by_quadrature(model, cosine, glm::vec3(albedo), 0, roughness, 48).r);
            };
            with += sum(MaterialModel::gltf);
            without += sum(MaterialModel::appendix_b);
        }
        return with / without - 1;
    };
    fmt::print(
        "    mean change of the diffuse lobe by the limit: albedo .8, roughness .3 {:+.2f} %; albedo .7, roughness "
        ".2 {:+.2f} %; albedo 1, roughness 0 {:+.2f} %\n",
        100 * change(0.8f, 0.3f), 100 * change(0.7f, 0.2f), 100 * change(1, 0));
    EXPECT_GT(change(0.8f, 0.3f), -0.01);
    EXPECT_GT(change(1, 0), -0.12);
}

// What gathers and maps take, which know one direction only.
TEST(LobeAlbedo, OneDirectionIsEnough) {
    double worst = 0, usual = 0;
    for (float roughness : {0.0f, 0.3f, 0.6f, 1.0f}) {
        for (float albedo : {0.3f, 0.8f, 1.0f}) {
            for (float cosine : {0.05f, 0.3f, 0.6f, 1.0f}) {
                const float exact =
                    diffuse_by_quadrature(MaterialModel::gltf, cosine, glm::vec3(albedo), 0, roughness).r;
                const float known = diffuse_albedo(MaterialModel::gltf, glm::vec3(albedo), 0, roughness, cosine).r;
                const double off = double(known / exact - 1);
                EXPECT_GT(off, -1e-3) << "it only leaves a limit out";
                worst = std::max(worst, off);
                if (albedo < 0.9f && roughness > 0.2f) usual = std::max(usual, off);
                EXPECT_NEAR(diffuse_albedo(MaterialModel::appendix_b, glm::vec3(albedo), 0, roughness, cosine).r,
                            diffuse_by_quadrature(MaterialModel::appendix_b, cosine, glm::vec3(albedo), 0, roughness).r,
                            1e-3f * albedo);
            }
        }
    }
    fmt::print("    albedo with one direction known: {:.2f} % too bright at most, {:.2f} % up to .8 and from .3 on\n",
               100 * worst, 100 * usual);
    EXPECT_LT(usual, 0.005);
    EXPECT_LT(worst, 0.08);
}

TEST(MaterialModel, NamesAreTheOnesOfTheShot) {
    EXPECT_EQ(material_model_named("plain"), MaterialModel::plain);
    EXPECT_EQ(material_model_named("gltf"), MaterialModel::gltf);
    EXPECT_EQ(material_model_named("appendix_b"), MaterialModel::appendix_b);
    try {
        material_model_named("phong");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "invalid material model 'phong': expected plain, gltf, appendix_b");
    }
}

} // namespace bounce
