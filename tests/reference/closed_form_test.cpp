// Scenes whose light transport is known exactly: the reference must agree within 0.3 %.

#include "reference/render.h"
#include "scenes.h"

#include <gtest/gtest.h>
#include <memory>

using namespace bounce;
using namespace bounce::test;

namespace {

constexpr double k_tolerance = 0.003;

double mean(const Image& image) {
    return image_mean(image, Mask(image.width, image.height));
}

#define EXPECT_WITHIN(value, expected) EXPECT_NEAR((value) / (expected), 1.0, k_tolerance)

} // namespace

// A closed box of albedo a that emits E everywhere has the radiance E/(1 − a), whatever its shape.
TEST(ClosedForm, WhiteFurnace) {
    SceneMaker maker;
    maker.box({-1, -2, -1.5f}, {1, 0.5f, 2}, maker.material(glm::vec3(0.5f), glm::vec3(0.8f)));
    maker.camera({0.3f, -0.5f, 0.1f}, {-1, -1, -2}, 70);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    EXPECT_WITHIN(mean(render.part("out.radiance")), 0.8 / (1 - 0.5));
    EXPECT_WITHIN(mean(render.part("out.emission")), 0.8);
    EXPECT_WITHIN(mean(render.part("out.emitted")), 0.4);
    EXPECT_WITHIN(mean(render.part("out.indirect_diffuse")), 0.4);
    EXPECT_WITHIN(mean(render.part("irradiance.emitted")), 0.8 * k_pi_d);
    EXPECT_EQ(mean(render.part("out.ambient_occlusion")), 0);
    EXPECT_EQ(mean(render.part("out.direct")), 0);
    EXPECT_EQ(mean(render.part("out.indirect_specular")), 0);
}

// Limited to k bounces the sum breaks off: E·(1 + a + … + a^(k+1)).
TEST(ClosedForm, TruncatedSeries) {
    for (int bounces : {0, 1, 2, 3}) {
        SceneMaker maker;
        maker.shot.width = maker.shot.height = 12;
        maker.box({-1, -1, -1}, {1, 1, 1}, maker.material(glm::vec3(0.6f), glm::vec3(1)));
        maker.camera({0, 0, 0}, {1, 0.4f, 0.2f}, 80);
        ReferenceSettings settings;
        settings.bounces = bounces;
        ReferenceRender render(maker.shot, settings);
        render.render_to(128);
        EXPECT_WITHIN(mean(render.part("out.radiance")), (1 - std::pow(0.6, bounces + 2)) / (1 - 0.6)) << bounces;
        const double indirect = 0.36 * (1 - std::pow(0.6, bounces)) / (1 - 0.6);
        if (bounces == 0)
            EXPECT_EQ(mean(render.part("out.indirect_diffuse")), 0);
        else
            EXPECT_WITHIN(mean(render.part("out.indirect_diffuse")), indirect) << bounces;
    }
}

// Roulette at work: high albedo, many bounces.
TEST(ClosedForm, BrightFurnace) {
    SceneMaker maker;
    maker.box({-1, -1, -1}, {1, 1, 1}, maker.material(glm::vec3(0.9f), glm::vec3(1)));
    maker.camera({0, 0, 0}, {1, 0.4f, 0.2f}, 80);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    EXPECT_WITHIN(mean(render.part("out.radiance")), 10.0);
}

// In a sphere of radius R and albedo ρ with a point light I in its centre, the direct irradiance is I/R² everywhere and
// each bounce adds ρ times the one before.
TEST(ClosedForm, IntegratingSphere) {
    SceneMaker maker;
    const float rho = 0.7f;
    maker.sphere(2, 48, maker.material(glm::vec3(rho)));
    maker.light(LightType::point, {0, 0, 0}, {0, -1, 0}, 5);
    maker.camera({0.5f, 0.2f, 0}, {-1, 0.1f, 0.3f}, 60);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    const double e = 5.0 / 4;
    EXPECT_WITHIN(mean(render.part("irradiance.direct")), e);
    EXPECT_WITHIN(mean(render.part("out.direct")), rho / k_pi_d * e);
    EXPECT_WITHIN(mean(render.part("irradiance.indirect")), e * rho / (1 - rho));
    EXPECT_WITHIN(mean(render.part("out.indirect_diffuse")), rho / k_pi_d * e * rho / (1 - rho));

    ReferenceSettings two;
    two.bounces = 2;
    ReferenceRender limited(maker.shot, two);
    limited.render_to(128);
    EXPECT_WITHIN(mean(limited.part("irradiance.indirect")), e * (rho + rho * rho));
}

namespace {

/// A floor of albedo ρ seen from straight above through a narrow view; its middle is at the origin.
SceneMaker floor_scene(float rho, float vfov_degrees = 2) {
    SceneMaker maker;
    maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(glm::vec3(rho)));
    maker.camera({0, 20, 0}, {0, 0, 0}, vfov_degrees, {0, 0, -1});
    return maker;
}

} // namespace

TEST(ClosedForm, PlaneUnderADirectionalLight) {
    SceneMaker maker = floor_scene(0.4f);
    const float angle = 0.9f;
    maker.light(LightType::directional, {0, 0, 0}, {std::sin(angle), -std::cos(angle), 0}, 3);
    ReferenceRender render(maker.shot, {});
    render.render_to(4);
    EXPECT_WITHIN(mean(render.part("out.direct")), 0.4 / k_pi_d * 3 * std::cos(angle));
    EXPECT_EQ(mean(render.part("out.ambient_occlusion")), 1);
}

TEST(ClosedForm, PlaneUnderPointAndSpotLights) {
    // I·cosθ/d²; with h the height and r the distance along the floor: I·h/(h² + r²)^(3/2).
    const double h = 2, r = 1.5, d2 = h * h + r * r;
    const double irradiance = 7 * h / std::pow(d2, 1.5);
    {
        SceneMaker maker = floor_scene(0.4f, 0.1f);
        maker.light(LightType::point, {1.5f, 2, 0}, {0, -1, 0}, 7);
        ReferenceRender render(maker.shot, {});
        render.render_to(4);
        EXPECT_WITHIN(mean(render.part("irradiance.direct")), irradiance);
    }
    {
        // The spot looks straight down; the origin is at the angle atan(r/h) from its axis, between its cones.
        SceneMaker maker = floor_scene(0.4f, 0.1f);
        maker.light(LightType::spot, {1.5f, 2, 0}, {0, -1, 0}, 7, 0.4f, 0.9f);
        const double angle = std::atan2(r, h);
        const double t = (std::cos(angle) - std::cos(0.9)) / (std::cos(0.4) - std::cos(0.9));
        ReferenceRender render(maker.shot, {});
        render.render_to(4);
        EXPECT_WITHIN(mean(render.part("irradiance.direct")), irradiance * t * t);
    }
}

// A light with a radius gives the irradiance of the hard one at normal incidence, and a sphere that lies wholly above
// the horizon gives it at every angle (Lambert: the irradiance of a sphere is that of its centre).
TEST(ClosedForm, LightsWithARadiusKeepTheirIrradiance) {
    const double h = 2, r = 1.5, irradiance = 7 * h / std::pow(h * h + r * r, 1.5);
    SceneMaker maker = floor_scene(0.4f, 0.1f);
    maker.light(LightType::point, {1.5f, 2, 0}, {0, -1, 0}, 7, 0, 0.78f, 0.8f);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    EXPECT_WITHIN(mean(render.part("irradiance.direct")), irradiance);

    SceneMaker sun = floor_scene(0.4f, 0.1f);
    sun.light(LightType::directional, {0, 0, 0}, {1, -2, 0}, 3, 0, 0.78f, 0, 0.3f);
    ReferenceRender sunlit(sun.shot, {});
    sunlit.render_to(256);
    EXPECT_WITHIN(mean(sunlit.part("irradiance.direct")), 3 * 2 / std::sqrt(5.0));
}

// Two opposite unit squares, three apart; the upper one emits. The mean irradiance of the lower one is π·L·F. It is
// seen from afar, which weights its area evenly; a second light of known irradiance tells how much of each pixel it
// covers.
TEST(ClosedForm, ParallelPlates) {
    SceneMaker maker;
    maker.shot.width = maker.shot.height = 24;
    maker.quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, maker.material(glm::vec3(0)));
    maker.quad({-0.5f, 3, -0.5f}, {1, 0, 0}, {0, 0, 1}, maker.material(glm::vec3(0), glm::vec3(2)));
    const glm::vec3 view = glm::normalize(glm::vec3(1, 1.2f, 0));
    maker.camera(300.0f * view, {0, 0, 0}, 0.25f);
    maker.light(LightType::directional, {0, 0, 0}, {1, -1, 0}, 1);
    ReferenceSettings settings;
    settings.bounces = 0;
    ReferenceRender render(maker.shot, settings);
    render.render_to(400);
    const double covered = mean(render.part("irradiance.direct")) / std::sqrt(0.5);
    EXPECT_GT(covered, 0.3);
    EXPECT_WITHIN(mean(render.part("irradiance.emitted")) / covered, 2 * k_pi_d * plates_form_factor(1, 1, 3));
}

// An environment of radiance L over a floor, of which a black roof hides the share F: E = π·L·(1 − F), and the same
// share is the ambient occlusion.
TEST(ClosedForm, EnvironmentOverAPlaneWithAnOccluder) {
    for (bool as_map : {false, true}) {
        SceneMaker maker = floor_scene(0.5f, 0.01f);
        const float a = 0.8f, b = 1.4f, height = 1;
        maker.quad({-a, height, -b}, {2 * a, 0, 0}, {0, 0, 2 * b}, maker.material(glm::vec3(0)));
        maker.camera({6, 2.5f, 0}, {0, 0, 0}, 0.02f);
        maker.shot.environment.radiance = glm::vec3(1.5f);
        if (as_map) {
            maker.shot.environment.map = Image(32, 16, 3);
            std::fill(maker.shot.environment.map.pixels.begin(), maker.shot.environment.map.pixels.end(), 1.0f);
        }
        ReferenceSettings settings;
        settings.occlusion_distance = 1e-4f;
        ReferenceRender render(maker.shot, settings);
        render.render_to(256);
        const double open = 1 - 4 * corner_form_factor(a, b, height);
        EXPECT_WITHIN(mean(render.part("irradiance.environment")), 1.5 * k_pi_d * open) << as_map;
        EXPECT_WITHIN(mean(render.part("out.environment")), 0.5 * 1.5 * open) << as_map;
        EXPECT_WITHIN(mean(render.part("out.ambient_occlusion")), open) << as_map;
        EXPECT_EQ(mean(render.part("out.ambient_occlusion_dmax")), 1) << as_map;
    }
}

// A wide roof at height h and d_max = R: a ray at θ meets it at h/cosθ, so that with k = h/R the share 1 − k² of the
// cosine-weighted hemisphere meets it within R. Without falloff k² stays open; with W = 1 − (d/R)² it is
// k² + ∫ 2cosθ·(k/cosθ)² d(cosθ) over cosθ > k = k²·(1 − 2·ln k).
TEST(ClosedForm, OcclusionWithinDmaxUnderARoof) {
    SceneMaker maker = floor_scene(0.5f);
    maker.quad({-30, 1, -30}, {0, 0, 60}, {60, 0, 0}, maker.material(glm::vec3(0.5f)));
    maker.camera({0, 0.9f, 0}, {0, 0, 0}, 2, {0, 0, -1});
    const double diagonal = std::sqrt(100.0 * 100 + 100 * 100 + 1);
    for (const double k : {0.25, 0.5, 0.8}) {
        ReferenceSettings settings;
        settings.bounces = 0;
        settings.occlusion_distance = float(1 / (k * diagonal));
        ReferenceRender hard(maker.shot, settings);
        hard.render_to(256);
        EXPECT_NEAR(mean(hard.part("out.ambient_occlusion_dmax")), k * k, 2e-3);
        settings.occlusion_falloff = OcclusionFalloff::quadratic;
        ReferenceRender fading(maker.shot, settings);
        fading.render_to(256);
        EXPECT_NEAR(mean(fading.part("out.ambient_occlusion_dmax")), k * k * (1 - 2 * std::log(k)), 2e-3);
        EXPECT_NE(hard.key(), fading.key()) << "one must not be taken for the other in the cache";
    }
}

// A map that is bright in its upper quarter only: the part of the hemisphere within 45° of the zenith gives E =
// π·L·sin²45°.
TEST(ClosedForm, EnvironmentMapIsTheRightWayUp) {
    SceneMaker maker = floor_scene(0.5f);
    maker.shot.environment.radiance = glm::vec3(1);
    maker.shot.environment.map = Image(64, 256, 3);
    auto& pixels = maker.shot.environment.map.pixels;
    std::fill(pixels.begin(), pixels.begin() + ptrdiff_t(pixels.size() / 4), 3.0f);
    ReferenceRender render(maker.shot, {});
    render.render_to(128);
    EXPECT_WITHIN(mean(render.part("irradiance.environment")), 3 * k_pi_d * 0.5);
}

// A point of light in a map (one texel): its irradiance is its radiance times its solid angle times the cosine.
TEST(ClosedForm, SmallBrightSpotInAnEnvironmentMap) {
    SceneMaker maker = floor_scene(0.5f);
    maker.shot.environment.radiance = glm::vec3(1);
    maker.shot.environment.map = Image(256, 128, 3);
    std::fill_n(maker.shot.environment.map.at(40, 30), 3, 5000.0f);
    ReferenceRender render(maker.shot, {});
    render.render_to(256);
    double expected = 0; // the tent of bilinear reading around the texel's centre
    const int steps = 64;
    for (int j = -steps; j < steps; ++j) {
        for (int i = -steps; i < steps; ++i) {
            const double x = (i + 0.5) / steps, y = (j + 0.5) / steps;
            const double theta = k_pi_d * (30.5 + y) / 128;
            expected += 5000 * (1 - std::abs(x)) * (1 - std::abs(y)) * std::sin(theta) * std::cos(theta) *
                        (2 * k_pi_d / 256) * (k_pi_d / 128) / (steps * steps);
        }
    }
    EXPECT_WITHIN(mean(render.part("irradiance.environment")), expected);
}

// A mirror shows what it reflects: with F0 = 1 and little roughness, nearly all of it.
TEST(ClosedForm, MirrorReflectsTheEnvironmentAndEmitters) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(glm::vec3(1), glm::vec3(0), 1, 0.05f));
    maker.camera({0, 5, 5}, {0, 0, 0}, 5);
    maker.shot.environment.radiance = glm::vec3(0.7f);
    ReferenceRender render(maker.shot, {});
    render.render_to(16);
    EXPECT_WITHIN(mean(render.part("out.environment")), 0.7);
    EXPECT_EQ(mean(render.part("out.indirect_diffuse")), 0);

    // A wall of radiance 2 fills the reflection; it also shines on itself by way of the mirror, in later orders.
    maker.quad({-90, -1, -10}, {180, 0, 0}, {0, 150, 0}, maker.material(glm::vec3(0), glm::vec3(2)));
    ReferenceRender wall(maker.shot, {});
    wall.render_to(64);
    EXPECT_WITHIN(mean(wall.part("out.emitted")), 2.0);
}

// Specular bounces: a closed box of F0 = 1 smooth metal and uniform emission is a furnace too; the lobe's missing
// energy at α = 0.0025 is far below the tolerance. With two scattering orders: E·(1 + 1 + 1).
TEST(ClosedForm, SpecularFurnace) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.box({-1, -1, -1}, {1, 1, 1}, maker.material(glm::vec3(1), glm::vec3(1), 1, 0.05f));
    maker.camera({0, 0, 0}, {1, 0.4f, 0.2f}, 80);
    ReferenceSettings settings;
    settings.bounces = 1;
    ReferenceRender render(maker.shot, settings);
    render.render_to(64);
    EXPECT_WITHIN(mean(render.part("out.emitted")), 1.0);
    EXPECT_WITHIN(mean(render.part("out.indirect_specular")), 1.0);
    EXPECT_WITHIN(mean(render.part("out.radiance")), 3.0);
    // Metal has no diffuse lobe: behind the visible surface nothing is scattered any more.
    settings.diffuse_secondary = true;
    ReferenceRender diffuse_behind(maker.shot, settings);
    diffuse_behind.render_to(64);
    EXPECT_EQ(diffuse_behind.part("out.emitted").pixels, render.part("out.emitted").pixels);
    EXPECT_EQ(mean(diffuse_behind.part("out.indirect_specular")), 0);
    EXPECT_NE(diffuse_behind.key(), render.key());
}

// Glossy surfaces behind the visible one, and only they, lose their microfacet lobe: first scatterings are those of the
// whole material, and what the visible surface's diffuse lobe reflects is what it reflects in a diffuse scene.
TEST(ClosedForm, DiffuseSecondarySurfaces) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    maker.box({-1, -1, -1}, {1, 1, 1}, maker.material(glm::vec3(0.6f), glm::vec3(1), 0.3f, 0.4f));
    maker.camera({0, 0, 0}, {1, 0.4f, 0.2f}, 80);
    auto render = [&](bool only, bool secondary) {
        auto r = std::make_unique<ReferenceRender>(
            maker.shot, ReferenceSettings{.bounces = 2, .diffuse_only = only, .diffuse_secondary = secondary});
        r->render_to(16);
        return r;
    };
    const auto whole = render(false, false), secondary = render(false, true), only = render(true, false);
    EXPECT_EQ(secondary->part("out.emitted").pixels, whole->part("out.emitted").pixels);
    EXPECT_EQ(secondary->part("out.indirect_diffuse").pixels, only->part("out.indirect_diffuse").pixels);
    const double gloss = mean(secondary->part("out.indirect_specular"));
    EXPECT_GT(gloss, 0);
    EXPECT_LT(gloss, mean(whole->part("out.indirect_specular")));
    EXPECT_EQ(mean(only->part("out.indirect_specular")), 0);
}
