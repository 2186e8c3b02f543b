// Rays through the trees against a search through all triangles, in double precision: both layouts, with trees in the
// world and shared ones, things that stand, move, mirror and flatten.
#include "support/made_scenes.h"
#include "support/ray_probe.h"

#include <cmath>
#include <limits>

using namespace bounce;

namespace {

struct Form {
    const char* name;
    bool wide, shared;
};

struct Nearest {
    double t = std::numeric_limits<double>::infinity();
    double margin = 1; ///< least barycentric weight of the hit: how far inside of the triangle it lies
};

/// Möller and Trumbore, in the world.
Nearest search(const SceneRunner& run, const ProbedRay& ray) {
    Nearest nearest;
    const glm::dvec3 origin(ray.origin), direction(ray.direction);
    for (const Instance& instance : run.state.instances) {
        const glm::dmat4 world(instance.world);
        for (uint32_t i = 0; i + 2 < instance.primitive.index_count; i += 3) {
            glm::dvec3 p[3];
            for (uint32_t k = 0; k < 3; ++k)
                p[k] = glm::dvec3(
                    world *
                    glm::dvec4(run.scene.vertices[run.scene.indices[instance.primitive.first_index + i + k]].position,
                               1));
            const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], q = glm::cross(direction, e2);
            const double det = glm::dot(e1, q);
            if (det == 0 || !std::isfinite(det)) continue;
            const glm::dvec3 from = origin - p[0], r = glm::cross(from, e1);
            const double u = glm::dot(from, q) / det, v = glm::dot(direction, r) / det, t = glm::dot(e2, r) / det;
            const double inside = std::min(u, std::min(v, 1 - u - v));
            if (inside < 0 || t <= 0 || t >= nearest.t) continue;
            nearest = {t, inside};
        }
    }
    return nearest;
}

class TracedRays : public SceneGraphTest {
  protected:
    SceneRunner runner(Scene scene, int count, const Form& form = {"", false, false},
                       const char* rays = k_rays_through_bounds, bool seeded = false) {
        shader("user/probe.comp", probe_shader(rays));
        return SceneRunner(
            std::move(scene), {}, graph_file(probe_graph(count, seeded)),
            {{"bvh.wide_nodes", form.wide ? "true" : "false"}, {"bvh.share_all", form.shared ? "true" : "false"}});
    }
    std::vector<ProbedRay> probe(SceneRunner& run) {
        run.frame();
        return run.read_buffer<ProbedRay>("probe.rays");
    }
    /// Rays through rims, and the tree's rounding of moved things, may fall on either side.
    void expect_searched(const SceneRunner& run, const std::vector<ProbedRay>& rays, const std::string& what) {
        size_t hits = 0, wrong = 0;
        for (const ProbedRay& ray : rays) {
            EXPECT_EQ(ray.any != 0, ray.hit()) << what;
            const Nearest nearest = search(run, ray);
            hits += std::isfinite(nearest.t);
            const double tolerance = 1e-5 * double(run.facts.bounds_over_animation.diagonal());
            const bool same = ray.hit() ? std::abs(double(ray.t) - nearest.t) <= tolerance : !std::isfinite(nearest.t);
            if (!same && nearest.margin > 1e-5) ++wrong;
        }
        EXPECT_GT(hits, rays.size() / 10) << what;
        EXPECT_EQ(wrong, 0u) << what << ": of " << rays.size();
    }
};

/// Tilted, scaled, mirrored, flattened copies of the blocks.
Scene placed_blocks() {
    Scene scene = blocks();
    const int mesh = scene.nodes[0].mesh;
    const glm::dvec3 scales[] = {{0.6, 0.6, 0.6}, {1.5, -0.7, 0.9}, {1, 0, 1}};
    for (int i = 0; i < 3; ++i) {
        Node& node = scene.nodes.emplace_back();
        node.mesh = mesh;
        node.translation = {0.7 * i - 1, 1.2 + 0.5 * i, 0.4 * i};
        node.rotation = glm::normalize(glm::dquat(0.8, 0.3 * i, -0.5, 0.2));
        node.scale = scales[i];
    }
    return scene;
}

class InEachForm : public TracedRays, public testing::WithParamInterface<Form> {};

/// A sphere of triangles with common vertices, in a scene's units anywhere.
Scene sphere(glm::vec3 centre, float radius, int rings) {
    Scene scene;
    scene.nodes.emplace_back().mesh = 0;
    Mesh& mesh = scene.meshes.emplace_back();
    scene.materials.emplace_back();
    auto vertex = [&](int ring, int step) {
        const float theta = 3.14159265f * float(ring) / float(rings),
                    phi = 3.14159265f * float(step % (2 * rings)) / float(rings);
        Vertex v;
        v.position = centre + radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                 std::sin(theta) * std::sin(phi));
        if (ring == 0 || ring == rings) v.position = centre + glm::vec3(0, ring == 0 ? radius : -radius, 0);
        scene.vertices.push_back(v);
        return uint32_t(scene.vertices.size() - 1);
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < 2 * rings; ++step)
            for (const auto& [r, s] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
                scene.indices.push_back(vertex(ring + r, step + s));
    mesh.primitives.push_back({0, uint32_t(scene.indices.size()), 0});
    return scene;
}

} // namespace

TEST_P(InEachForm, HitsAreThoseOfASearchThroughAllTriangles) {
    SceneRunner run = runner(blocks(), 20000, GetParam());
    expect_searched(run, probe(run), GetParam().name);
}

TEST_P(InEachForm, CopiesThatMoveAreFoundWhereTheyAre) {
    SceneRunner run = runner(placed_blocks(), 8000, GetParam());
    for (size_t i = 0; i < run.state.instances.size(); ++i)
        run.state.instances[i].dynamic = run.state.instances[i].node > 0;
    run.facts.dynamic_instances = run.state.instances.size();
    expect_searched(run, probe(run), "at first");
    for (Instance& instance : run.state.instances)
        if (instance.dynamic)
            instance.world = glm::mat4(glm::mat3(instance.world)) * glm::mat4(1),
            instance.world[3] = {0.3f, 0.8f, -0.5f, 1};
    expect_searched(run, probe(run), "moved");
    for (Instance& instance : run.state.instances) // one that stands may be edited too
        if (!instance.dynamic) instance.world[3].y += 0.25f;
    expect_searched(run, probe(run), "edited");
}

/// From the inside of a closed surface no ray gets out: neither between triangles nor through their corners.
TEST_P(InEachForm, NoRayLeavesAClosedSurface) {
    for (const glm::vec3 centre : {glm::vec3(0), glm::vec3(40, -7, 1000)}) {
        const char* rays =
            "vec3 centre = 0.5 * (scene_min + scene_max), size = scene_max - scene_min;"
            "origin = centre + 0.2 * (a - 0.5) * size;"
            "uint v = hash_u32(ray) % uint(vertices.length()), e = indices[hash_u32(ray) % uint(indices.length())];"
            "vec3 corner = vertices[v].position_u.xyz, other = vertices[e].position_u.xyz;"
            "direction = ray % 3u == 0u ? b - 0.5 : (ray % 3u == 1u ? corner - origin : mix(corner, other, b.x) - "
            "origin);";
        SceneRunner run = runner(sphere(centre, 1.3f, 24), 60000, GetParam(), rays);
        size_t lost = 0;
        for (const ProbedRay& ray : probe(run))
            lost += !ray.hit() || !ray.any;
        EXPECT_EQ(lost, 0u) << "around " << centre.z;
    }
}

TEST_P(InEachForm, TrianglesWithoutAreaOrOutsideOfNumbersAreHarmless) {
    Scene whole = blocks(), damaged = blocks();
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3 bad : {glm::vec3(nan, 0, 0), glm::vec3(infinity, 0, 0), glm::vec3(0.2f, 0.3f, 0.1f)}) {
        const auto base = uint32_t(damaged.vertices.size());
        const bool number = std::isfinite(bad.x);
        for (int k = 0; k < 3; ++k) {
            damaged.vertices.emplace_back().position = number && k == 1 ? bad
                                                       : number         ? glm::vec3(-0.1f, 0.4f, 0.3f)
                                                                        : bad;
            damaged.indices.push_back(base + uint32_t(k));
        }
        damaged.meshes[0].primitives.push_back({uint32_t(damaged.indices.size()) - 3, 3, 0});
    }
    SceneRunner good = runner(std::move(whole), 5000, GetParam());
    const std::vector<ProbedRay> expected = probe(good);
    SceneRunner bad = runner(std::move(damaged), 5000, GetParam());
    bad.facts = good.facts; // bounds that are numbers
    const std::vector<ProbedRay> rays = probe(bad);
    for (size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(rays[i].t, expected[i].t);
        EXPECT_EQ(rays[i].corner, expected[i].corner);
    }
}

TEST_P(InEachForm, AlphaOpensMaskedSurfaces) {
    for (const bool by_texture : {false, true}) {
        SceneRunner run =
            runner(half_transparent(by_texture), 4000, GetParam(),
                   "origin = vec3(2.0 * a.x - 1.0, 3.0, 1.2 * a.y - 0.6); direction = vec3(0.0, -1.0, 0.0);");
        size_t hits = 0;
        for (const ProbedRay& ray : probe(run)) {
            if (std::abs(ray.origin.x) < 0.05f) continue; // the texture's own blur
            EXPECT_EQ(ray.hit(), ray.origin.x > 0) << ray.origin.x << (by_texture ? " by texture" : " by vertex");
            hits += ray.hit();
        }
        EXPECT_GT(hits, 1500u);
    }
}

/// k blended layers let (1 − α)^k through.
TEST_P(InEachForm, BlendedSurfacesStopTheirShareOfRays) {
    MadeScene made;
    for (int i = 0; i < 3; ++i) {
        const float y = float(i);
        made.quad({-1, y, 1}, {1, y, 1}, {1, y, -1}, {-1, y, -1});
        made.material().alpha_mode = AlphaMode::blend;
        made.material().base_colour.a = 0.3f;
    }
    constexpr int k_count = 40000;
    SceneRunner run =
        runner(made.scene, k_count, GetParam(),
               "origin = vec3(1.8 * a.x - 0.9, 5.0, 1.8 * a.y - 0.9); direction = vec3(0.0, -1.0, 0.0);", true);
    std::array<int, 4> stopped{};
    for (const ProbedRay& ray : probe(run))
        ++stopped[size_t(ray.hit() ? std::lround(ray.origin.y - ray.t) : 3)];
    const double share[] = {0.7 * 0.7 * 0.3, 0.7 * 0.3, 0.3, 0.343}; // from the lowest layer up; through
    for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(stopped[i] / double(k_count), share[i], 4 * std::sqrt(share[i] * (1 - share[i]) / k_count));
}

INSTANTIATE_TEST_SUITE_P(TracedRays, InEachForm,
                         testing::Values(Form{"threaded", false, false}, Form{"threaded_shared", false, true},
                                         Form{"wide", true, false}, Form{"wide_shared", true, true}),
                         [](const auto& form) { return std::string(form.param.name); });

/// Where two triangles lie in one place, every form hits the same one.
TEST_F(TracedRays, AllFormsGiveTheSameTriangles) {
    Scene twice = blocks();
    twice.nodes.emplace_back().mesh = 0; // all of it once more
    std::vector<ProbedRay> first;
    for (const Form form :
         {Form{"", false, false}, Form{"", true, false}, Form{"", false, true}, Form{"", true, true}}) {
        SceneRunner run = runner(twice, 5000, form);
        const std::vector<ProbedRay> rays = probe(run);
        if (first.empty()) first = rays;
        for (size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(rays[i].draw, first[i].draw);
            EXPECT_EQ(rays[i].corner, first[i].corner);
            EXPECT_EQ(rays[i].t, first[i].t);
        }
    }
}

TEST_F(TracedRays, AnEmptySceneIsMissed) {
    SceneRunner run = runner(Scene{}, 100, {"", false, false}, "origin = a; direction = b + vec3(0.1);");
    for (const ProbedRay& ray : probe(run))
        EXPECT_FALSE(ray.hit() || ray.any);
}

TEST_F(TracedRays, ASceneTooLargeIsToldWithTheNumbers) {
    for (const bool wide : {false, true}) {
        SceneRunner run = runner(blocks(), 10, {"", wide, false});
        run.facts.triangles = 3'000'000'000;
        const std::string text = error_of([&] { run.graph.prepare(run.facts, run.size); });
        EXPECT_NE(text.find("3,000,000,000 triangles"), std::string::npos) << text;
        EXPECT_NE(text.find("expected at most"), std::string::npos) << text;
    }
}
