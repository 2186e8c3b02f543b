// What surfaces look like: lobes, textures, alpha, normals, and estimators that must agree with each other.

#include "core/low_discrepancy.h"
#include "reference/render.h"
#include "reference/sampling.h"
#include "scene/brdf.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace bounce;
using namespace bounce::test;

namespace {

double mean(const Image& image) {
    return image_mean(image, Mask(image.width, image.height));
}

glm::vec3 direction(float theta, float phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The albedo of the microfacet lobe (times its Fresnel term), by drawing visible normals.
double lobe_albedo(float cosine, float roughness, const glm::vec3& base, float metallic) {
    const glm::vec3 n(0, 0, 1), v = direction(std::acos(cosine), 0);
    const float alpha = brdf_alpha(roughness);
    double sum = 0;
    const uint32_t count = 20000;
    for (uint32_t i = 0; i < count; ++i) {
        PixelSampler sampler(1, i, true);
        const glm::vec3 h = visible_normal(v, alpha, sampler.next_pair());
        const glm::vec3 l = 2.0f * glm::dot(v, h) * h - v;
        if (l.z <= 0) continue;
        const float density = visible_normal_density(ggx_density(n, glm::normalize(v + l), alpha), cosine, alpha);
        sum += brdf_specular(n, v, l, base, metallic, roughness).r * l.z / density;
    }
    return sum / count;
}

/// The same by a plain sum over directions, for lobes that are not too narrow.
double lobe_albedo_by_quadrature(float cosine, float roughness, const glm::vec3& base, float metallic) {
    const glm::vec3 n(0, 0, 1), v = direction(std::acos(cosine), 0);
    double sum = 0;
    const int steps = 600;
    for (int i = 0; i < steps; ++i) {
        const float c = (float(i) + 0.5f) / steps;
        for (int j = 0; j < steps; ++j) {
            const glm::vec3 l = direction(std::acos(c), 2 * k_pi * (float(j) + 0.5f) / steps);
            sum += brdf_specular(n, v, l, base, metallic, roughness).r * c;
        }
    }
    return sum * 2 * k_pi_d / (double(steps) * steps);
}

} // namespace

TEST(Brdf, IsReciprocal) {
    for (uint32_t i = 0; i < 2000; ++i) {
        PixelSampler sampler(3, i, false);
        const glm::vec2 a = sampler.next_pair(), b = sampler.next_pair(), m = sampler.next_pair();
        const glm::vec3 n(0, 0, 1), v = direction(1.5f * a.x, 6.28f * a.y), l = direction(1.5f * b.x, 6.28f * b.y);
        const glm::vec3 base(m.x, 0.5f, 0.9f);
        const glm::vec3 forward = brdf_specular(n, v, l, base, m.y, sampler.next());
        PixelSampler again(3, i, false);
        for (int k = 0; k < 3; ++k)
            again.next_pair();
        const glm::vec3 backward = brdf_specular(n, l, v, base, m.y, again.next());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(forward[c], backward[c], 1e-4f * (1e-3f + forward[c]));
    }
}

TEST(Brdf, IsBlackBelowTheHorizon) {
    const glm::vec3 n(0, 0, 1), up = direction(0.5f, 1), down = direction(2.0f, 2);
    EXPECT_EQ(brdf_specular(n, up, down, glm::vec3(1), 1, 0.5f), glm::vec3(0));
    EXPECT_EQ(brdf_specular(n, down, up, glm::vec3(1), 1, 0.5f), glm::vec3(0));
}

TEST(Brdf, DensityOfMicrofacetsCoversTheSurfaceOnce) {
    // ∫ D(h)·(n·h) dh = 1.
    for (float roughness : {0.3f, 0.6f, 1.0f}) {
        const float alpha = brdf_alpha(roughness);
        double sum = 0;
        const int steps = 40000;
        for (int i = 0; i < steps; ++i) {
            const float c = (float(i) + 0.5f) / steps;
            sum += ggx_density({0, 0, 1}, direction(std::acos(c), 0), alpha) * c;
        }
        EXPECT_NEAR(sum * 2 * k_pi_d / steps, 1, 2e-3) << roughness;
    }
}

TEST(Brdf, DrawnAndSummedAlbedoAgree) {
    for (float cosine : {0.2f, 0.6f, 0.95f}) {
        for (float roughness : {0.4f, 0.7f, 1.0f}) {
            const double drawn = lobe_albedo(cosine, roughness, glm::vec3(0.8f), 1);
            EXPECT_NEAR(drawn / lobe_albedo_by_quadrature(cosine, roughness, glm::vec3(0.8f), 1), 1, 4e-3)
                << cosine << " " << roughness;
        }
    }
}

// The white furnace of the lobe alone (F0 = 1): single scattering loses energy with roughness and never gains any. The
// plain sum with Lambert may exceed 1 for bright dielectrics at grazing angles; the table says by how much.
TEST(Brdf, WhiteFurnaceIsReported) {
    std::string table = "cosine:     0.05   0.20   0.50   1.00\n";
    for (float roughness : {0.1f, 0.3f, 0.5f, 0.7f, 1.0f}) {
        char line[160];
        double metal[4], sum[4];
        const float cosines[4] = {0.05f, 0.2f, 0.5f, 1.0f};
        for (int i = 0; i < 4; ++i) {
            metal[i] = lobe_albedo(cosines[i], roughness, glm::vec3(1), 1);
            sum[i] = 1 + lobe_albedo(cosines[i], roughness, glm::vec3(1), 0);
            EXPECT_LE(metal[i], 1.002) << roughness;
        }
        std::snprintf(line, sizeof line,
                      "roughness %.1f, F0 = 1:    %.3f  %.3f  %.3f  %.3f   white dielectric:  %.3f  %.3f  %.3f  %.3f\n",
                      double(roughness), metal[0], metal[1], metal[2], metal[3], sum[0], sum[1], sum[2], sum[3]);
        table += line;
    }
    std::printf("albedo of the microfacet lobe, and of Lambert + lobe\n%s", table.c_str());
    EXPECT_GT(lobe_albedo(1.0f, 0.1f, glm::vec3(1), 1), 0.99);
}

// The tracer against quadrature of the plain sum: a rough metal floor under a point light and a uniform sky.
TEST(Material, GlossyFloorMatchesTheBrdf) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.shot.material_model = MaterialModel::plain;
    const glm::vec3 base(0.8f, 0.5f, 0.2f);
    maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(base, glm::vec3(0), 0.7f, 0.5f));
    maker.camera({0, 4, 3}, {0, 0, 0}, 0.05f);
    maker.light(LightType::point, {-1, 2, -1}, {0, -1, 0}, 5);
    maker.shot.environment.radiance = glm::vec3(0.6f);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    const glm::vec3 n(0, 1, 0), v = glm::normalize(glm::vec3(0, 4, 3)), l = glm::normalize(glm::vec3(-1, 2, -1));
    const glm::vec3 f = brdf_diffuse(base, 0.7f) + brdf_specular(n, v, l, base, 0.7f, 0.5f);
    const double expected = 5.0 / 6 * l.y * (f.r + f.g + f.b) / 3;
    EXPECT_NEAR(mean(render.part("out.direct")) / expected, 1, 3e-3);
    double sky = 0;
    for (int c = 0; c < 3; ++c) {
        sky += (lobe_albedo(0.8f, 0.5f, glm::vec3(base[c]), 0.7f) + base[c] * 0.3) * 0.6 / 3;
    }
    EXPECT_NEAR(mean(render.part("out.environment")) / sky, 1, 3e-3);
}

// The same picture by different estimators: a lamp met by chance only, or asked by next-event estimation and weighted.
// A sphere light of radius r about a point is compared with an emissive ball of the same radiance.
TEST(Material, SphereLightAndEmissiveBallAgree) {
    for (float roughness : {0.15f, 0.5f}) {
        auto scene = [&](bool ball) {
            SceneMaker maker;
            maker.shot.diffuse_only = false;
            maker.shot.width = maker.shot.height = 24;
            maker.quad({-20, -2, -20}, {0, 0, 40}, {40, 0, 0},
                       maker.material(glm::vec3(0.6f), glm::vec3(0), 0.5f, roughness));
            const float radius = 0.5f, radiance = 3;
            if (ball)
                maker.sphere(radius, 40, maker.material(glm::vec3(0), glm::vec3(radiance)));
            else
                maker.light(LightType::point, {0, 0, 0}, {0, -1, 0}, radiance * k_pi * radius * radius, 0, 0.7f,
                            radius);
            maker.camera({0, 0, 5}, {0, -2, 0}, 25);
            return maker.shot;
        };
        ReferenceSettings settings;
        settings.bounces = 0;
        ReferenceRender ball(scene(true), settings), light(scene(false), settings);
        ball.render_to(128);
        light.render_to(128);
        EXPECT_NEAR(mean(light.part("out.direct")) / mean(ball.part("out.emitted")), 1, 0.006) << roughness;
    }
}

// Many lights are drawn from, few are all asked: the mean is the same.
TEST(Material, ManyLightsAreDrawnWithoutBias) {
    auto scene = [](int copies, float radius) {
        SceneMaker maker;
        maker.shot.width = maker.shot.height = 24;
        maker.quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, maker.material(glm::vec3(0.6f)));
        maker.quad({-3, 0, -3}, {6, 0, 0}, {0, 4, 0}, maker.material(glm::vec3(0.6f)));
        for (int i = 0; i < 2 * copies; ++i) {
            maker.light(LightType::point, {i % 2 ? 1.0f : -1.5f, i % 2 ? 1.0f : 2.0f, 0}, {0, -1, 0},
                        (i % 2 ? 3.0f : 8.0f) / float(copies), 0, 0.7f, radius);
        }
        maker.camera({0, 2, 6}, {0, 1, -1}, 40);
        return maker.shot;
    };
    for (float radius : {0.0f, 0.2f}) {
        ReferenceSettings settings;
        settings.bounces = 1;
        ReferenceRender few(scene(1, radius), settings), many(scene(12, radius), settings);
        few.render_to(128);
        many.render_to(128);
        for (const char* part : {"out.direct", "out.indirect_diffuse"}) {
            EXPECT_NEAR(mean(many.part(part)) / mean(few.part(part)), 1, 0.01) << part << " " << radius;
        }
    }
}

namespace {

/// A floor whose texture is two by one texels, seen so that the image shows u from left to right.
SceneMaker textured_floor(const std::vector<uint8_t>& rgba, bool srgb, bool nearest) {
    SceneMaker maker;
    Texture texture;
    texture.image = {2, 1, rgba};
    texture.srgb = srgb;
    texture.nearest = nearest;
    maker.shot.scene.textures.push_back(texture);
    const int material = maker.material(glm::vec3(1));
    maker.shot.scene.materials[0].base_colour_texture.texture = 0;
    maker.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, material);
    maker.camera({0, 10, 0}, {0, 0, 0}, 11.42f, {0, 0, -1});
    maker.light(LightType::directional, {0, 0, 0}, {0, -1, 0}, k_pi);
    return maker;
}

} // namespace

TEST(Material, TexturesAreDecodedFilteredAndPlaced) {
    const std::vector<uint8_t> grey{128, 128, 128, 255, 255, 255, 255, 255};
    for (bool srgb : {false, true}) {
        SceneMaker maker = textured_floor(grey, srgb, true);
        ReferenceRender render(maker.shot, {});
        render.render_to(2);
        const float dark = srgb ? srgb_decode(128.0f / 255) : 128.0f / 255;
        EXPECT_NEAR(render.part("out.direct").at(3, 8)[0], dark, 1e-4f);
        EXPECT_NEAR(render.part("out.direct").at(12, 8)[0], 1, 1e-4f);
    }
    // Bilinear: halfway between the texels' centres (u = ½) lies the mean of the decoded values.
    SceneMaker maker = textured_floor(grey, true, false);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    const Image out = render.part("out.direct");
    EXPECT_NEAR((out.at(7, 8)[0] + out.at(8, 8)[0]) / 2, (1 + srgb_decode(128.0f / 255)) / 2, 2e-3f);
    // A transform moves it: half a texture to the side exchanges the halves (repeat).
    SceneMaker moved = textured_floor(grey, true, true);
    moved.shot.scene.materials[0].base_colour_texture.offset = {0.5f, 0};
    ReferenceRender exchanged(moved.shot, {});
    exchanged.render_to(2);
    EXPECT_NEAR(exchanged.part("out.direct").at(3, 8)[0], 1, 1e-4f);
    // Metalness takes from the diffuse colour.
    SceneMaker metal = textured_floor(grey, false, true);
    metal.shot.scene.materials[0].metallic = 0.25f;
    ReferenceRender dimmed(metal.shot, {});
    dimmed.render_to(2);
    EXPECT_NEAR(dimmed.part("out.direct").at(12, 8)[0], 0.75f, 1e-4f);
}

// A sheet above the floor whose left half is cut out by its alpha: seen through, lit through, and open to the sky.
TEST(Material, AlphaTestedTexelsAreNotThere) {
    SceneMaker maker = textured_floor({255, 255, 255, 0, 255, 255, 255, 255}, false, true);
    maker.shot.scene.materials[0].alpha_mode = AlphaMode::mask;
    maker.quad({-5, -1, -5}, {10, 0, 0}, {0, 0, 10}, maker.material(glm::vec3(0.5f)));
    ReferenceRender render(maker.shot, {});
    render.render_to(16);
    const LayeredImage image = render.image();
    EXPECT_EQ(*image.layers.at("gbuffer.material").at(3, 8), 1);
    EXPECT_EQ(*image.layers.at("gbuffer.material").at(12, 8), 0);
    EXPECT_NEAR(image.layers.at("out.direct").at(3, 8)[0], 0.5f, 1e-4f); // the light passes as the view does
    EXPECT_GT(*image.layers.at("out.ambient_occlusion").at(3, 8), 0.0f);
}

// A normal map that leans all normals toward +x by 30° lights the floor as a tilted one.
TEST(Material, NormalMapsTilt) {
    const float tilt = k_pi / 6;
    auto level = [](float x) { return uint8_t(std::lround(255 * (0.5f + 0.5f * x))); };
    const uint8_t r = level(std::sin(tilt)), b = level(std::cos(tilt));
    for (bool on : {true, false}) {
        SceneMaker maker = textured_floor({r, 128, b, 255, r, 128, b, 255}, false, true);
        Material& material = maker.shot.scene.materials[0];
        material.base_colour_texture.texture = -1;
        material.normal_texture.texture = 0;
        maker.shot.normal_maps = on;
        maker.shot.scene.lights[0].direction = {0, -1, 0};
        ReferenceRender render(maker.shot, {});
        render.render_to(2);
        const Image normal = render.image().layers.at("gbuffer.normal");
        EXPECT_NEAR(normal.at(8, 8)[0], on ? std::sin(tilt) : 0, 0.01f);
        EXPECT_NEAR(render.part("out.direct").at(8, 8)[0], on ? std::cos(tilt) : 1, 0.01f);
    }
}

TEST(Material, VertexColoursMultiply) {
    SceneMaker maker = textured_floor({255, 255, 255, 255, 255, 255, 255, 255}, false, true);
    for (Vertex& vertex : maker.shot.scene.vertices) {
        vertex.colour_rg = glm::packUnorm2x16({0.5f, 0.25f});
        vertex.colour_ba = glm::packUnorm2x16({1, 1});
    }
    ReferenceRender render(maker.shot, {});
    render.render_to(2);
    EXPECT_NEAR(render.part("out.direct").at(8, 8)[0], 0.5f, 1e-3f);
    EXPECT_NEAR(render.part("out.direct").at(8, 8)[1], 0.25f, 1e-3f);
}

// Emission by a texture: half of the lamp is dark; the irradiance is that of the lit half.
TEST(Material, TexturedEmitters) {
    SceneMaker maker;
    Texture texture;
    texture.image = {2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
    texture.nearest = true;
    maker.shot.scene.textures.push_back(texture);
    maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(glm::vec3(0.5f)));
    const int lamp = maker.material(glm::vec3(0), glm::vec3(2));
    maker.shot.scene.materials[size_t(lamp)].emission_texture.texture = 0;
    maker.quad({-1, 1.5f, 0}, {2, 0, 0}, {0, 0, 1}, lamp);
    maker.camera({0, 1, 8}, {0, 0, 0}, 0.01f);
    ReferenceSettings settings;
    settings.bounces = 0;
    ReferenceRender render(maker.shot, settings);
    render.render_to(256);
    EXPECT_NEAR(mean(render.part("irradiance.emitted")) / (2 * k_pi_d * corner_form_factor(1, 1, 1.5)), 1, 3e-3);
}

// Both sides of a surface are alike, whatever way its triangles wind.
TEST(Material, SurfacesHaveTwoSides) {
    for (float side : {1.0f, -1.0f}) {
        SceneMaker maker;
        maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(glm::vec3(0.5f), glm::vec3(0.25f)));
        maker.camera({0, side * 3, 0.5f}, {0, 0, 0}, 10);
        maker.light(LightType::directional, {0, 0, 0}, {0, -side, 0}, 2);
        ReferenceRender render(maker.shot, {});
        render.render_to(2);
        EXPECT_NEAR(mean(render.part("out.direct")), 1 / k_pi_d, 1e-4);
        EXPECT_NEAR(mean(render.part("out.emission")), 0.25, 1e-6);
        // Lit from behind it stays dark.
        maker.shot.scene.lights[0].direction.y *= -1;
        maker.shot.scene.nodes.back().rotation = glm::quat(glm::vec3(side * k_pi / 2, 0, 0));
        ReferenceRender behind(maker.shot, {});
        behind.render_to(2);
        EXPECT_EQ(mean(behind.part("out.direct")), 0);
    }
}

TEST(Sampling, TablesDrawByWeight) {
    const std::vector<float> weights{0, 1, 0, 3, 0.5f, 0, 0};
    const WeightedTable table(weights);
    std::vector<int> counts(weights.size());
    const int count = 45000;
    for (int i = 0; i < count; ++i) {
        float u = (float(i) + 0.5f) / count;
        ++counts[table.draw(u)];
        EXPECT_TRUE(u >= 0 && u < 1);
    }
    for (size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(counts[i], count * weights[i] / 4.5f, 3) << i;
        EXPECT_NEAR(table.probability(i), weights[i] / 4.5f, 1e-6f);
    }
    float last = 0x1.fffffep-1;
    EXPECT_EQ(table.draw(last), 4u);
    EXPECT_TRUE(WeightedTable(std::vector<float>{0, 0}).empty());
    EXPECT_TRUE(WeightedTable().empty());
}
