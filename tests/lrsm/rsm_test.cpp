// Reflective shadow maps against closed forms: ρ·L_d·⟨n·l⟩/π, normal and depth of every texel.
#include "lrsm/rsm_fixture.h"

#include <algorithm>
#include <fmt/format.h>

using namespace bounce;

namespace {

constexpr int k_resolution = 64;
const glm::dvec3 k_floor_colour(0.8f, 0.4f, 0.2f), k_shelf_colour(0.1f, 0.5f, 0.9f);

/// A floor at y = 0, and a shelf at y = ½ over its left part.
Scene floor_and_shelf() {
    return MadeScene()
        .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, glm::vec3(k_floor_colour))
        .quad({-2, 0.5f, 2}, {-0.3f, 0.5f, 2}, {-0.3f, 0.5f, -2}, {-2, 0.5f, -2}, glm::vec3(k_shelf_colour))
        .scene;
}

/// What the ray from `origin` meets; height < 0: nothing, or too near a rim to tell.
struct Hit {
    double height = -1, t = 0;
    glm::dvec3 point{0};
    bool certain = true;
};
Hit meet(glm::dvec3 origin, glm::dvec3 direction, double slack) {
    Hit hit;
    for (double height : {0.5, 0.0}) {
        double t = (height - origin.y) / direction.y;
        glm::dvec3 p = origin + t * direction;
        double right = height > 0 ? -0.3 : 2.0;
        double inside = std::min({p.x + 2, right - p.x, 2 - std::abs(p.z)});
        if (std::abs(inside) < slack) hit.certain = false;
        if (t > 0 && inside > 0) {
            hit.height = height, hit.t = t, hit.point = p;
            return hit;
        }
    }
    return hit;
}

class Rsm : public SceneGraphTest {
  protected:
    /// Compares each texel with the light's closed form; returns how many hold a surface.
    int compare(const Light& light) {
        SceneRunner run(
            floor_and_shelf(), {light},
            graph_file(fmt::format(R"("passes":[{{"type":"rsm","params":{{"resolution":{}}}}}])", k_resolution)));
        run.frame();
        ReflectiveShadowMaps maps(run);
        int held = 0, uncertain = 0;
        for (int view = 0; view < maps.size.z; ++view) {
            const ShadowView& v = maps.views[size_t(view)];
            glm::dmat4 inverse = glm::inverse(glm::dmat4(v.view_projection));
            for (int y = 0; y < maps.size.y; ++y) {
                for (int x = 0; x < maps.size.x; ++x) {
                    glm::dvec2 plane = (glm::dvec2(x, y) + 0.5) / double(k_resolution) * 2.0 - 1.0;
                    // A metre away: the near plane is too near to tell a direction.
                    glm::dvec4 near = inverse * glm::dvec4(plane, v.range > 0 ? 1.0 : double(v.near_plane), 1);
                    glm::dvec3 on_ray = glm::dvec3(near) / near.w, origin(v.origin), direction(v.direction);
                    if (v.range > 0)
                        origin = on_ray;
                    else
                        direction = glm::normalize(on_ray - origin);
                    if (direction.y >= -1e-3) continue; // grazing the horizon, or away from the floor
                    Hit hit = meet(origin, direction, 1e-3);
                    if (!hit.certain) {
                        ++uncertain;
                        continue;
                    }
                    EXPECT_EQ(maps.holds(view, x, y), hit.height >= 0) << view << ": " << x << ", " << y;
                    if (hit.height < 0 || !maps.holds(view, x, y)) continue;
                    ++held;
                    double along = glm::dot(hit.point - glm::dvec3(v.origin), glm::dvec3(v.direction));
                    EXPECT_NEAR(maps.distance(view, x, y), along, 2e-4 * along) << x << ", " << y;
                    glm::dvec4 normal = maps.normal_at(view, x, y);
                    EXPECT_NEAR(glm::length(normal - glm::dvec4(0, 1, 0, 1)), 0, 1e-3) << x << ", " << y;
                    expect_radiance(light, hit, maps.radiance_at(view, x, y));
                }
            }
        }
        EXPECT_LT(uncertain, held / 10);
        return held;
    }

    static void expect_radiance(const Light& light, const Hit& hit, glm::dvec4 got) {
        glm::dvec3 colour = hit.height > 0 ? k_shelf_colour : k_floor_colour;
        glm::dvec3 l = -glm::dvec3(light.direction), irradiance(light.intensity);
        double rim = 0;
        if (light.type != LightType::directional) {
            glm::dvec3 to = glm::dvec3(light.position) - hit.point;
            l = glm::normalize(to);
            irradiance /= glm::dot(to, to);
        }
        if (light.type == LightType::spot) {
            double outer = std::cos(double(light.outer_cone)), inner = std::cos(double(light.inner_cone));
            double share = std::clamp((glm::dot(-l, glm::dvec3(light.direction)) - outer) / (inner - outer), 0.0, 1.0);
            irradiance *= share * share;
            rim = share < 0.05 ? 1e-3 : 0; // the difference of two cosines in float, squared, has no digits left
        }
        EXPECT_NEAR(got.a, l.y, 1e-3);
        for (int c = 0; c < 3; ++c) {
            double expected = colour[c] * irradiance[c] * l.y / M_PI;
            EXPECT_NEAR(got[c], expected, half_tolerance(expected) + 5e-4 * expected + rim * irradiance[c] + 1e-6);
        }
    }
};

} // namespace

TEST_F(Rsm, OfASpotHoldsWhatTheSurfacesSendOn) {
    EXPECT_GT(compare(spot_light({0.2f, 3, -0.1f}, {0.1f, -1, 0.15f}, {9, 6, 3}, 12, 28)), 3000);
}
TEST_F(Rsm, OfADirectionalLightHoldsWhatTheSurfacesSendOn) {
    EXPECT_GT(compare(directional_light({0.3f, -1, -0.2f}, {2, 3, 4})), 1000);
}
TEST_F(Rsm, OfAPointLightHoldsWhatTheSurfacesSendOn) {
    EXPECT_GT(compare(point_light({0.4f, 1.7f, 0.3f}, {5, 4, 3})), 3000);
}

/// The map's sides are the cone's: half-way along a side the ray makes the outer angle.
TEST_F(Rsm, OfASpotReachesToItsOuterCone) {
    Light light = spot_light({0, 3, 0}, {0.2f, -1, 0.1f}, {1, 1, 1}, 10, 35);
    SceneRunner run(floor_and_shelf(), {light}, graph_file(R"("passes":[{"type":"rsm","params":{"resolution":64}}])"));
    run.frame();
    ShadowView view = run.read_buffer<ShadowView>("rsm.views").at(0);
    glm::dmat4 inverse = glm::inverse(glm::dmat4(view.view_projection));
    for (glm::dvec2 side : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        glm::dvec4 p = inverse * glm::dvec4(side, double(view.near_plane), 1); // a metre away
        glm::dvec3 direction = glm::normalize(glm::dvec3(p) / p.w - glm::dvec3(view.origin));
        EXPECT_NEAR(std::acos(glm::dot(direction, glm::dvec3(view.direction))), glm::radians(35.0), 1e-4);
    }
    EXPECT_NEAR(view.texel_size, 2 * std::tan(glm::radians(35.0)) / 64, 1e-6);
}

/// Surfaces that turn away from the light are lit by nothing.
TEST_F(Rsm, ATiltedSurfaceHoldsItsOwnNormal) {
    Scene scene = MadeScene().quad({-1, 0, 1}, {1, 0.4f, 1}, {1, 1, -1}, {-1, 0.6f, -1}).scene;
    glm::dvec3 n(scene.vertices[0].normal);
    Light light = directional_light({0, -1, 0}, {1, 1, 1});
    SceneRunner run(scene, {light}, graph_file(R"("passes":[{"type":"rsm","params":{"resolution":32}}])"));
    run.frame();
    ReflectiveShadowMaps maps(run);
    int held = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            if (!maps.holds(0, x, y)) continue;
            ++held;
            EXPECT_NEAR(glm::length(glm::dvec3(maps.normal_at(0, x, y)) - n), 0, 1e-3);
            EXPECT_NEAR(maps.radiance_at(0, x, y).a, n.y, 1e-3);
            EXPECT_NEAR(maps.radiance_at(0, x, y).r, 0.5 * n.y / M_PI, 2e-4);
        }
    }
    EXPECT_GT(held, 500);
}
