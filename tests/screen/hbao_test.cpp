// Horizon-based occlusion where the depth buffer holds all that occludes: against the hemisphere's integral over the
// scene's triangles, and what follows from symmetry and from d_max.
#include "scene/camera_ray.h"
#include "support/scene_runner.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>

using namespace bounce;

namespace {

using Sets = std::vector<std::pair<std::string, std::string>>;
constexpr int k_size = 96;
constexpr double k_pi = 3.14159265358979323846;

const char* const k_graph =
    R"("resources":{"out.ambient_occlusion":{"format":"r32f"},"out.ambient_occlusion_dmax":{"format":"r32f"}},
    "passes":[{"type":"gbuffer"},{"id":"hbao","type":"compute","shader":"screen/hbao.comp"},
              {"id":"hbao_dmax","type":"compute","shader":"screen/hbao_dmax.comp","params_of":"hbao"}])";

/// Many directions and samples, the same in every pixel, nothing lost below the bias: what the method itself can reach.
Sets converged(const char* weighting) {
    return {{"hbao.weighting", weighting}, {"hbao.zenith", "view_ray"}, {"hbao.directions", "32"},
            {"hbao.steps", "128"},         {"hbao.angle_bias", "0.5"},  {"hbao.bias_lifts_tangent", "false"},
            {"hbao.interleave", "1"}};
}

struct Hit {
    double distance = INFINITY;
    glm::dvec3 position{0}, normal{0};
};

Hit trace(const Scene& scene, glm::dvec3 origin, glm::dvec3 direction) {
    Hit hit;
    for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
        glm::dvec3 a = scene.vertices[scene.indices[i]].position, b = scene.vertices[scene.indices[i + 1]].position,
                   c = scene.vertices[scene.indices[i + 2]].position;
        glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        double along = glm::dot(n, direction);
        if (std::abs(along) < 1e-12) continue;
        double t = glm::dot(a - origin, n) / along;
        if (t < 1e-6 || t >= hit.distance) continue;
        glm::dvec3 p = origin + t * direction;
        bool inside = glm::dot(glm::cross(b - a, p - a), n) >= -1e-12 &&
                      glm::dot(glm::cross(c - b, p - b), n) >= -1e-12 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= -1e-12;
        if (inside) hit = {t, p, along < 0 ? n : -n};
    }
    return hit;
}

/// The mean visibility over the hemisphere, weighted by the cosine or uniformly; an occluder at distance d blocks W(d).
double oracle(const Scene& scene, const Hit& at, bool cosine, const std::function<double(double)>& w) {
    constexpr int k_rings = 64, k_turns = 192;
    glm::dvec3 t =
        glm::normalize(glm::cross(at.normal, std::abs(at.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    glm::dvec3 b = glm::cross(at.normal, t), origin = at.position + 1e-5 * at.normal;
    double open = 0;
    for (int i = 0; i < k_rings; ++i) {
        double u = (i + 0.5) / k_rings, z = cosine ? std::sqrt(u) : u, r = std::sqrt(1 - z * z);
        for (int j = 0; j < k_turns; ++j) {
            double phi = 2 * k_pi * (j + 0.5) / k_turns;
            Hit hit = trace(scene, origin, r * std::cos(phi) * t + r * std::sin(phi) * b + z * at.normal);
            open += std::isinf(hit.distance) ? 1 : 1 - w(hit.distance);
        }
    }
    return open / (k_rings * k_turns);
}

class Hbao : public SceneGraphTest {
  protected:
    struct Pictures {
        std::vector<float> open, open_dmax;
        double diagonal = 0;
    };
    Pictures render(const Scene& scene, const Sets& sets) {
        SceneRunner run(scene, {}, graph_file(k_graph), sets, {k_size, k_size});
        run.camera = camera;
        run.frame();
        return {run.read("out.ambient_occlusion"), run.read("out.ambient_occlusion_dmax"),
                run.facts.bounds_over_animation.diagonal()};
    }
    Hit seen(const Scene& scene, int x, int y) const {
        return trace(scene, camera.position,
                     camera_ray(camera_basis(camera.position, camera.target, camera.up), std::tan(0.5f * camera.vfov),
                                glm::vec2(k_size), glm::vec2(x, y) + 0.5f));
    }
    /// RMS and mean difference from the oracle over every ninth pixel whose neighbours lie in its plane.
    std::pair<double, double> error(const Scene& scene, const std::vector<float>& got, bool cosine,
                                    const std::function<double(double)>& w) const {
        double squares = 0, sum = 0;
        int count = 0;
        for (int y = 4; y < k_size - 4; y += 9) {
            for (int x = 4; x < k_size - 4; x += 9) {
                Hit at = seen(scene, x, y);
                if (std::isinf(at.distance)) continue;
                bool flat = true;
                for (auto [dx, dy] : {std::pair(2, 0), {-2, 0}, {0, 2}, {0, -2}}) {
                    Hit other = seen(scene, x + dx, y + dy);
                    flat = flat && std::abs(glm::dot(other.position - at.position, at.normal)) < 1e-4;
                }
                if (!flat) continue;
                double difference = double(got[size_t(y * k_size + x)]) - oracle(scene, at, cosine, w);
                squares += difference * difference;
                sum += difference;
                ++count;
            }
        }
        EXPECT_GT(count, 20);
        return {std::sqrt(squares / count), sum / count};
    }

    Camera camera;
};

/// A floor and a wall that meet: all of both is in the picture.
Scene corner() {
    return MadeScene()
        .quad({-1, 0, 0}, {-1, 0, 2}, {1, 0, 2}, {1, 0, 0})
        .quad({-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0})
        .scene;
}
Camera before_the_corner() {
    Camera camera;
    camera.position = {0.3f, 2.2f, 4};
    camera.target = {0, 0.35f, 0.6f};
    camera.vfov = 0.62f;
    return camera;
}

/// A square pit of depth 0.5 in a plate.
Scene pit() {
    constexpr float a = 0.4f, d = -0.5f, far = 1;
    MadeScene made;
    made.quad({-a, d, a}, {a, d, a}, {a, d, -a}, {-a, d, -a});
    made.quad({-a, d, -a}, {a, d, -a}, {a, 0, -a}, {-a, 0, -a}).quad({-a, d, a}, {-a, 0, a}, {a, 0, a}, {a, d, a});
    made.quad({-a, d, -a}, {-a, 0, -a}, {-a, 0, a}, {-a, d, a}).quad({a, d, -a}, {a, d, a}, {a, 0, a}, {a, 0, -a});
    made.quad({-far, 0, -a}, {far, 0, -a}, {far, 0, -far}, {-far, 0, -far})
        .quad({-far, 0, far}, {far, 0, far}, {far, 0, a}, {-far, 0, a});
    made.quad({-far, 0, a}, {-a, 0, a}, {-a, 0, -a}, {-far, 0, -a})
        .quad({a, 0, a}, {far, 0, a}, {far, 0, -a}, {a, 0, -a});
    return made.scene;
}
Camera above_the_pit() {
    Camera camera;
    camera.position = {0, 2.5f, 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.vfov = 0.8f;
    return camera;
}

} // namespace

TEST_F(Hbao, AnOpenPlaneIsOpenUnderAnyView) {
    Scene plane = MadeScene().quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}).scene;
    for (glm::vec3 eye : {glm::vec3(0, 3, 0.1f), glm::vec3(2, 1, 3), glm::vec3(-6, 0.4f, 1)}) {
        camera.position = eye;
        for (const Sets& sets : {Sets{}, converged("uniform"), converged("cosine")}) {
            Pictures pictures = render(plane, sets);
            for (const std::vector<float>& picture : {pictures.open, pictures.open_dmax})
                for (float open : picture)
                    ASSERT_NEAR(open, 1, 1e-3) << eye.x;
        }
    }
}

// At 96² a texel of the wall is 2 cm or so: the nearest texel's place in it is off by half of that, beside walls of a
// metre.
TEST_F(Hbao, ACornerAndAPitAreTheHemispheresIntegral) {
    for (bool in_pit : {false, true}) {
        Scene scene = in_pit ? pit() : corner();
        camera = in_pit ? above_the_pit() : before_the_corner();
        for (bool cosine : {false, true}) {
            Pictures pictures = render(scene, converged(cosine ? "cosine" : "uniform"));
            auto [rms, bias] = error(scene, pictures.open, cosine, [](double) { return 1.0; });
            EXPECT_LT(rms, 0.02) << in_pit << cosine;
            EXPECT_LT(std::abs(bias), 0.012) << in_pit << cosine;
        }
    }
}

TEST_F(Hbao, AttenuationByDistanceIsThatOfTheRays) {
    Scene scene = corner();
    camera = before_the_corner();
    for (bool fades : {false, true}) {
        for (bool cosine : {false, true}) {
            Sets sets = converged(cosine ? "cosine" : "uniform");
            sets.emplace_back("hbao_dmax.d_max", "0.2");
            sets.emplace_back("hbao_dmax.falloff", fades ? "quadratic" : "none");
            Pictures pictures = render(scene, sets);
            double d_max = 0.2 * pictures.diagonal;
            auto [rms, bias] = error(scene, pictures.open_dmax, cosine, [&](double d) {
                return d >= d_max ? 0.0 : (fades ? 1 - d * d / (d_max * d_max) : 1.0);
            });
            EXPECT_LT(rms, 0.02) << fades << cosine;
            EXPECT_LT(std::abs(bias), 0.012) << fades << cosine;
        }
    }
}

TEST_F(Hbao, NothingBeyondDmaxCountsAndAllOfItBelow) {
    Scene scene = corner();
    camera = before_the_corner();
    std::vector<float> before;
    for (const char* d_max : {"0.02", "0.1", "0.3", "5"}) {
        Sets sets = converged("cosine");
        sets.emplace_back("hbao_dmax.d_max", d_max);
        sets.emplace_back("hbao_dmax.falloff", "none");
        Pictures pictures = render(scene, sets);
        double reach = std::atof(d_max) * pictures.diagonal;
        for (int y = 0; y < k_size; y += 5) {
            for (int x = 0; x < k_size; x += 5) {
                size_t i = size_t(y * k_size + x);
                Hit at = seen(scene, x, y);
                if (!std::isinf(at.distance) && at.normal.y > 0.5 && at.position.z > 1.02 * reach) {
                    ASSERT_NEAR(pictures.open_dmax[i], 1, 1e-4) << x << " " << y << " " << d_max;
                }
                if (std::atof(d_max) == 5) {
                    ASSERT_NEAR(pictures.open_dmax[i], pictures.open[i], 1e-5);
                }
            }
        }
        double sum = 0, sum_before = 0;
        for (size_t i = 0; i < pictures.open_dmax.size(); ++i) {
            sum += pictures.open_dmax[i];
            sum_before += before.empty() ? 1.0 : before[i];
        }
        EXPECT_LT(sum, sum_before);
        before = pictures.open_dmax;
    }
}

TEST_F(Hbao, AMirroredViewGivesTheMirroredPicture) {
    Scene scene = corner();
    camera = before_the_corner();
    camera.position.x = camera.target.x = 0;
    for (const char* weighting : {"uniform", "cosine"}) {
        std::vector<float> open = render(scene, converged(weighting)).open;
        double worst = 0, sum = 0;
        for (int y = 0; y < k_size; ++y) {
            for (int x = 0; x < k_size / 2; ++x) {
                double difference = std::abs(open[size_t(y * k_size + x)] - open[size_t(y * k_size + k_size - 1 - x)]);
                worst = std::max(worst, difference);
                sum += difference;
            }
        }
        EXPECT_LT(worst, 0.05) << weighting; // a line that falls between two texels may take either
        EXPECT_LT(sum / (k_size * k_size / 2), 1e-3) << weighting;
    }
}

// The blur as wide as the interleave sees every set of directions once, and keeps edges of depth.
TEST_F(Hbao, TheBlurLeavesFlatOcclusionAloneAndDoesNotCrossEdges) {
    shader("test/halves.comp", R"(#include "lib/frame.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D gbuffer_depth;
layout(FORMAT_screen_occlusion) writeonly uniform image2D screen_occlusion;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, resolution))) return;
    // Near and far surface, and a pattern of 4 x 4 on each.
    float near = world_position(pixel, max(texelFetch(gbuffer_depth, pixel, 0).r, 1.0e-30)).z > 0.5 ? 0.7 : 0.2;
    imageStore(screen_occlusion, pixel, vec4(near + (float(pixel.x % 4 + 4 * (pixel.y % 4)) - 7.5) / 100.0));
}
)");
    Scene scene = MadeScene()
                      .quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0})
                      .quad({0, -4, 1}, {4, -4, 1}, {4, 4, 1}, {0, 4, 1})
                      .scene;
    camera.position = {0, 0, 4};
    SceneRunner run(scene, {},
                    graph_file(R"("resources":{"screen.occlusion":{"format":"r32f"},"screen.blurred":{"format":"r32f"}},
        "passes":[{"type":"gbuffer"},{"id":"halves","type":"compute","shader":"test/halves.comp"},
                  {"id":"blur","type":"compute","shader":"screen/blur.comp","bind":{"screen.blurred":"screen.blurred"}}])"),
                    {}, {k_size, k_size});
    run.camera = camera;
    run.frame();
    std::vector<float> blurred = run.read("screen.blurred");
    for (int y = 4; y < k_size - 4; ++y) {
        for (int x = 4; x < k_size - 4; ++x) {
            float got = blurred[size_t(y * k_size + x)];
            if (std::abs(x - k_size / 2) <
                4) // part of the box lies on the other surface: no more than the pattern remains
                ASSERT_NEAR(got, x < k_size / 2 ? 0.2f : 0.7f, 0.08f) << x << " " << y;
            else
                ASSERT_NEAR(got, x < k_size / 2 ? 0.2f : 0.7f, 1e-4f) << x << " " << y;
        }
    }
}
