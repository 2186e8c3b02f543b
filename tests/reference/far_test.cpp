// Far from the origin, at any size, and outside of what rays can be traced in. These scenes are made in memory and are
// not loaded relative to their centre, so that the tracer is on its own.

#include "core/error.h"
#include "reference/integrator.h"
#include "reference/render.h"
#include "scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace bounce;
using namespace bounce::test;

namespace {

/// A floor of ρ = ½ one metre below a lamp of 1 W/sr, seen straight under it: ρ·I/π.
Shot floor_under_lamp(const glm::vec3& at, float tilt) {
    SceneMaker maker;
    const glm::vec3 x(std::cos(tilt), std::sin(tilt), 0), n(-std::sin(tilt), std::cos(tilt), 0), z(0, 0, 1);
    maker.quad(at - 4.0f * x - 4.0f * z, 8.0f * z, 8.0f * x, maker.material(glm::vec3(0.5f)));
    maker.light(LightType::point, at + n, -n, 1);
    maker.camera(at + 2.0f * n + 2.0f * z, at, 0.5f, n);
    maker.shot.width = maker.shot.height = 3;
    return maker.shot;
}

double mean_of(const Shot& shot, const char* part, int samples) {
    ReferenceRender render(shot, {});
    render.render_to(samples);
    const Image image = render.part(part);
    return image_mean(image, Mask(image.width, image.height));
}

} // namespace

TEST(Far, ALampOneMetreAboveAFloor) {
    const double truth = 0.5 / k_pi_d;
    for (float far : {0.0f, 1e3f, 1e4f, 1e5f}) {
        // 64 m: at 100 km floats lie 8 mm apart, and the scene's own points are to be among them.
        EXPECT_NEAR(mean_of(floor_under_lamp({far, 0, far}, 0), "out.direct", 64) / truth, 1, 0.005) << far;
        EXPECT_NEAR(mean_of(floor_under_lamp({far, -far, 0}, 0), "out.direct", 64) / truth, 1, 0.005) << far;
    }
}

TEST(Far, ATiltedFloorNeitherShadowsItselfNorLeaksLight) {
    // The corners of a tilted floor are rounded, at 100 km to 8 mm: of a metre, that is 1.6 % of E. What the tracer
    // adds is held against the same lamp over the triangles as they are.
    for (float far : {1e3f, 1e4f, 1e5f}) {
        const Shot shot = floor_under_lamp({far, far, -far}, 0.4f);
        const auto& v = shot.scene.vertices;
        const glm::dvec3 a(v[0].position);
        const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(v[1].position) - a, glm::dvec3(v[2].position) - a));
        const glm::dvec3 lamp(glm::vec3(shot.scene.nodes.back().translation));
        const double height = std::abs(glm::dot(lamp - a, n));
        // The camera looks at a point that may lie beside the lamp's foot by a few rounding steps.
        const glm::dvec3 eye(shot.camera.position), target(shot.camera.target), along = glm::normalize(target - eye);
        const glm::dvec3 seen = eye + along * (glm::dot(a - eye, n) / glm::dot(along, n));
        const double distance = glm::length(lamp - seen);
        const double truth = 0.5 / k_pi_d * height / (distance * distance * distance);
        EXPECT_NEAR(mean_of(shot, "out.direct", 64) / truth, 1, 0.005) << far;
    }
}

/// Light within a closed white-walled box of an emissive ceiling: rays that slip through walls, or that walls stop at
/// once, would show.
TEST(Far, ABoxOfEmittersIsTheSameFurnace) {
    for (float far : {0.0f, 1e4f, 1e5f}) {
        SceneMaker maker;
        const int glow = maker.material(glm::vec3(0.5f), glm::vec3(1));
        maker.box(glm::vec3(far, -far, far) - 4.0f, glm::vec3(far, -far, far) + 4.0f, glow);
        maker.camera(glm::vec3(far, -far, far), glm::vec3(far, -far, far) + glm::vec3(1, 0.5f, 0.25f), 80);
        // 1 + ½ + ¼ + …
        EXPECT_NEAR(mean_of(maker.shot, "out.emission", 16), 1, 1e-6) << far;
        EXPECT_NEAR(mean_of(maker.shot, "out.emitted", 256), 0.5, 0.005) << far;
        EXPECT_NEAR(mean_of(maker.shot, "out.indirect_diffuse", 256), 0.5, 0.01) << far;
    }
}

TEST(Far, RaysThatLeaveATriangleDoNotMeetIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    auto vector = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    size_t rays = 0, met = 0;
    float largest_offset = 0;
    for (float far : {0.0f, 1.0f, 1e2f, 1e4f, 1e6f})
        for (float size : {1e-3f, 1.0f, 1e3f}) {
            if (size < far * 1e-5f) continue; // not told apart any more
            for (int t = 0; t < 40; ++t) {
                SceneMaker maker;
                const glm::vec3 at = far * vector(), a = size * vector(), b = size * vector();
                maker.triangles({at, at + a, at + b}, maker.material(glm::vec3(0.5f)));
                const TraceGeometry geometry(maker.shot, evaluate_shot(maker.shot, 0).scene, true);
                for (int i = 0; i < 100; ++i) {
                    // From a point off the plane to one on it.
                    const float u = 0.45f + 0.4f * unit(random), v = (0.9f - u) * 0.5f * (1 + unit(random));
                    const glm::vec3 eye = at + (size + 0.1f) * 3.0f * vector();
                    const glm::vec3 direction = glm::normalize(at + u * a + v * b - eye);
                    const Hit hit = geometry.intersect(eye, direction, std::numeric_limits<float>::infinity());
                    if (!hit.valid()) continue;
                    const Surface surface = geometry.surface(hit, direction);
                    largest_offset = std::max(largest_offset, surface.offset / (std::abs(far) + size));
                    for (int k = 0; k < 4; ++k) {
                        glm::vec3 away = glm::normalize(vector());
                        if (k == 0)
                            away = glm::normalize(away - glm::dot(away, surface.geometric) * surface.geometric +
                                                  1e-3f * surface.geometric);
                        if (glm::dot(away, surface.geometric) < 0) away = -away;
                        ++rays;
                        met += geometry.occluded(surface.origin(), away, std::numeric_limits<float>::infinity());
                    }
                }
            }
        }
    EXPECT_GT(rays, 50000u);
    EXPECT_EQ(met, 0u) << "of " << rays;
    EXPECT_LT(largest_offset, 4e-6f) << "relative to the coordinates: a light must not shine through to the other side";
}

TEST(Far, WhatRaysDoNotReachIsRefused) {
    auto error = [](const Shot& shot) -> std::string {
        try {
            ReferenceRender render(shot, {});
            render.render_to(2);
        } catch (const Error& problem) {
            return problem.what();
        }
        return "";
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (float bad : {nan, infinity, -infinity, 1e19f, 1e30f}) {
        Shot shot = floor_under_lamp(glm::vec3(0), 0);
        shot.camera.position.y = bad;
        EXPECT_THAT(error(shot), testing::HasSubstr("camera")) << bad;
        shot = floor_under_lamp(glm::vec3(0), 0);
        shot.scene.vertices[1].position.x = bad;
        EXPECT_THAT(error(shot), testing::HasSubstr("vert")) << bad;
        shot = floor_under_lamp(glm::vec3(0), 0);
        shot.scene.nodes.back().translation.z = bad;
        EXPECT_THAT(error(shot), testing::HasSubstr("light")) << bad;
        shot = floor_under_lamp(glm::vec3(0), 0);
        shot.scene.nodes.front().translation.z = bad;
        EXPECT_THAT(error(shot), testing::HasSubstr("vert")) << bad;
    }
    for (float bad : {nan, infinity}) {
        Shot shot = floor_under_lamp(glm::vec3(0), 0);
        shot.scene.lights[0].intensity.g = bad;
        EXPECT_THAT(error(shot), testing::HasSubstr("intensity")) << bad;
    }
    EXPECT_EQ(error(floor_under_lamp(glm::vec3(0), 0)), "");
}
