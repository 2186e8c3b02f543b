// Nothing is too near for a camera or a light: small things in large scenes, against closed forms, by raster and
// reference.

#include "reference/render.h"
#include "support/scene_runner.h"

#include <cmath>

using namespace bounce;

namespace {

constexpr double k_pi_here = 3.14159265358979;

class NearPlane : public SceneGraphTest {
  protected:
    /// out.direct in the middle of the picture.
    struct Direct {
        double raster, reference;
    };
    static constexpr int k_side = 9; // odd: a pixel looks straight ahead
    Direct middle(const Scene& scene, const std::vector<Light>& lights, const Camera& camera) {
        SceneRunner run(scene, lights,
                        graph_file(R"("resources":{"out.direct":{"format":"rgba32f"}},"passes":[{"type":"gbuffer"},
                            {"type":"shadow_maps","params":{"resolution":256}},
                            {"id":"direct","type":"compute","shader":"surface/direct.comp"}])"),
                        {}, {k_side, k_side});
        run.camera = camera;
        run.frame();
        Shot shot;
        shot.scene = scene;
        shot.camera = camera;
        shot.width = shot.height = k_side;
        shot.diffuse_only = true;
        for (const Light& light : lights) {
            Node lamp;
            lamp.light = int(shot.scene.lights.size());
            lamp.translation = light.position;
            lamp.rotation = glm::dot(light.direction, glm::vec3(0, 0, 1)) > 0.999f
                                ? glm::quat(0, 0, 1, 0)
                                : glm::quat(glm::vec3(0, 0, -1), light.direction);
            shot.scene.lights.push_back(light);
            shot.scene.nodes.push_back(lamp);
        }
        ReferenceSettings settings;
        settings.bounces = 0;
        ReferenceRender reference(shot, settings);
        reference.render_to(16);
        Image direct = reference.part("out.direct");
        constexpr size_t k_middle = 4 * (k_side * k_side / 2);
        return {run.read("out.direct")[k_middle], direct.at(k_side / 2, k_side / 2)[0]};
    }
    void expect(const Direct& got, double value) {
        double slack = value > 0 ? 0.01 * value : 1e-12;
        EXPECT_NEAR(got.raster, value, slack);
        EXPECT_NEAR(got.reference, value, slack);
    }
    static Camera looking(glm::vec3 from, glm::vec3 at, float vfov = 0.02f) {
        Camera camera;
        camera.position = from;
        camera.target = at;
        camera.vfov = vfov;
        if (std::abs(glm::normalize(at - from).y) > 0.9f) camera.up = {0, 0, -1};
        return camera;
    }
};

MadeScene floor_of_5_km(float y = 0) {
    return MadeScene().quad({-2500, y, 2500}, {2500, y, 2500}, {2500, y, -2500}, {-2500, y, -2500});
}

} // namespace

TEST_F(NearPlane, AFloorBelowTheCamera) {
    Light sun = directional_light({0, -1, 0}, glm::vec3(1));
    for (float height : {1000.0f, 1.0f, 1e-3f}) {
        SCOPED_TRACE(height);
        expect(middle(floor_of_5_km().scene, {sun}, looking({0, height, 0}, {0, 0, 0}, 0.8f)), 0.5 / k_pi_here);
    }
}

TEST_F(NearPlane, AFloorOnWhichTheCameraStands) {
    // Looking ahead, so that one triangle runs from below the camera to the horizon.
    Light sun = directional_light({0, -1, 0}, glm::vec3(1));
    for (float height : {1.7f, 0.01f}) {
        SCOPED_TRACE(height);
        glm::vec3 eye(0.3f, height, 0.2f);
        expect(middle(floor_of_5_km().scene, {sun}, looking(eye, eye + glm::vec3(1, -1, 0.5f) * height)),
               0.5 / k_pi_here);
    }
}

TEST_F(NearPlane, ACameraInATinyRoomOfAHugeScene) {
    for (float s : {1e-2f, 1e-4f, 1e-6f}) {
        SCOPED_TRACE(s);
        MadeScene made = floor_of_5_km(-1);
        made.box(glm::vec3(-s), glm::vec3(s), glm::vec3(0.5f), true);
        Light lamp = point_light(s * glm::vec3(-0.5f, 0.3f, 0), glm::vec3(s * s));
        double d = std::sqrt(1.5 * 1.5 + 0.3 * 0.3);
        expect(middle(made.scene, {lamp}, looking(glm::vec3(0), {s, 0, 0})), 0.5 / k_pi_here * 1.5 / (d * d * d));
    }
}

TEST_F(NearPlane, ASpotAMillimetreFromAWall) {
    MadeScene made = floor_of_5_km(-1);
    made.quad({-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0});
    Light spot = spot_light({0, 0, 1e-3f}, {0, 0, -1}, glm::vec3(1e-6f), 20, 40);
    expect(middle(made.scene, {spot}, looking({0, 0, 0.02f}, {0, 0, 0}, 0.002f)), 0.5 / k_pi_here);
    // A plate between them, half as near.
    float r = 5e-4f;
    made.quad({-r, -r, r}, {r, -r, r}, {r, r, r}, {-r, r, r});
    expect(middle(made.scene, {spot}, looking({4e-4f, 0, 3e-4f}, {1e-4f, 0, 0}, 0.002f)), 0);
}

TEST_F(NearPlane, OccludersNextToALightCast) {
    // A plate a millimetre below the lamp shades all below 45°.
    for (float scale : {1.0f, 1e-2f}) {
        float r = 1e-3f * scale;
        MadeScene made = floor_of_5_km();
        made.quad({-r, 1 - r, r}, {r, 1 - r, r}, {r, 1 - r, -r}, {-r, 1 - r, -r});
        Light spot = spot_light({0, 1, 0}, {0, -1, 0}, glm::vec3(1), 10, 40),
              point = point_light({0, 1, 0}, glm::vec3(1));
        for (const Light& light : {spot, point}) {
            SCOPED_TRACE(int(light.type));
            expect(middle(made.scene, {light}, looking({0.3f, 0.5f, 0}, {0.3f, 0, 0})), 0);
        }
        expect(middle(made.scene, {point}, looking({3, 0.5f, 0}, {3, 0, 0})), 0.5 / k_pi_here / std::pow(10, 1.5));
    }
}

TEST_F(NearPlane, WhatStraysCastsAndReceivesSunlight) {
    Light sun = directional_light({0, -1, 0}, glm::vec3(1));
    MadeScene stage;
    stage.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}).box({0.5f, 0, 0.5f}, {1, 1, 1});
    // Too little and too far away to count for the bounds, but in the sun's way.
    MadeScene with_plate = stage;
    with_plate.quad({-0.04f, 300, 0.04f}, {0.04f, 300, 0.04f}, {0.04f, 300, -0.04f}, {-0.04f, 300, -0.04f});
    EXPECT_EQ(scene_facts(with_plate.scene).bounds.max.y, 300); // 6.4e-3 of 18 m² do count
    expect(middle(with_plate.scene, {sun}, looking({0, 1, 0}, {0, 0, 0})), 0);
    MadeScene with_chip = stage;
    with_chip.quad({-0.02f, 300, 0.02f}, {0.02f, 300, 0.02f}, {0.02f, 300, -0.02f}, {-0.02f, 300, -0.02f});
    EXPECT_EQ(scene_facts(with_chip.scene).bounds.max.y, 1);
    expect(middle(with_chip.scene, {sun}, looking({0, 1, 0}, {0, 0, 0})), 0);
    expect(middle(with_chip.scene, {sun}, looking({0.3f, 1, 0}, {0.3f, 0, 0})), 0.5 / k_pi_here);
    // A huge triangle above takes all light; one below receives it, but for what the stage blocks.
    MadeScene covered = stage;
    covered.triangle({-1e6f, 1e4f, 1e6f}, {1e6f, 1e4f, 1e6f}, {0, 1e4f, -1e6f});
    EXPECT_EQ(scene_facts(covered.scene).bounds.max.y, 1);
    expect(middle(covered.scene, {sun}, looking({0.3f, 1, 0}, {0.3f, 0, 0})), 0);
    MadeScene above = stage;
    above.triangle({-1e6f, -100, 1e6f}, {1e6f, -100, 1e6f}, {0, -100, -1e6f});
    EXPECT_EQ(scene_facts(above.scene).bounds.min.y, 0);
    expect(middle(above.scene, {sun}, looking({3, 5, 0}, {3, -100, 0})), 0.5 / k_pi_here); // beside the map
    expect(middle(above.scene, {sun}, looking({1, -50, 0}, {1, -100, 0})), 0);             // below the stage
    MadeScene gap; // two floors; what lies under the gap between them is in the map, and beyond its range
    gap.quad({-2, 0, 2}, {-1, 0, 2}, {-1, 0, -2}, {-2, 0, -2}).quad({1, 0, 2}, {2, 0, 2}, {2, 0, -2}, {1, 0, -2});
    gap.triangle({-1e6f, -100, 1e6f}, {1e6f, -100, 1e6f}, {0, -100, -1e6f});
    EXPECT_EQ(scene_facts(gap.scene).bounds.min.y, 0);
    expect(middle(gap.scene, {sun}, looking({0, -50, 0}, {0, -100, 0})), 0.5 / k_pi_here);
    expect(middle(gap.scene, {sun}, looking({1.5f, -50, 0}, {1.5f, -100, 0})), 0);
}

TEST_F(NearPlane, ACameraMayHaveItsOwn) {
    MadeScene made;
    made.quad({-1, -1, -0.5f}, {1, -1, -0.5f}, {1, 1, -0.5f}, {-1, 1, -0.5f}, glm::vec3(0.2f));
    made.quad({-4, -4, -3}, {4, -4, -3}, {4, 4, -3}, {-4, 4, -3}, glm::vec3(0.8f));
    Light lamp = point_light({0, 0, -2}, glm::vec3(1));
    Light front = point_light({0, 0, 0.5f}, glm::vec3(1));
    Camera camera = looking({0, 0, 0}, {0, 0, -1});
    expect(middle(made.scene, {lamp, front}, camera), 0.2 / k_pi_here); // the first wall, lit from 1 m
    camera.near_plane = 1;
    expect(middle(made.scene, {lamp, front}, camera), 0.8 / k_pi_here); // the second
    camera.near_plane = 0.45f;
    expect(middle(made.scene, {lamp, front}, camera), 0.2 / k_pi_here);
    // Seen aslant the first wall lies .673 m away along the view.
    camera.target = {0.9f, 0, -1};
    double to_first = std::sqrt(1 + 0.45 * 0.45), to_second = std::sqrt(1 + 2.7 * 2.7);
    camera.near_plane = 0.66f;
    expect(middle(made.scene, {lamp, front}, camera), 0.2 / k_pi_here / std::pow(to_first, 3));
    camera.near_plane = 0.68f;
    expect(middle(made.scene, {lamp, front}, camera), 0.8 / k_pi_here / std::pow(to_second, 3));
}
