// Voxelization against exact triangle–box overlap in double precision: which voxels, which means, and what moves.
#include "support/scene_runner.h"
#include "voxel/overlap_oracle.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

using namespace bounce;

namespace {

constexpr int k_resolution = 32;
const char* const k_graph = R"("passes":[{"type":"voxelization","params":{"resolution":32,"route":"compute"}}])";
using Sets = std::vector<std::pair<std::string, std::string>>;

/// Slanted, crossing and tiny surfaces, each of its own colour.
Scene slanted() {
    MadeScene made;
    made.box({-0.92f, -0.83f, -0.71f}, {-0.31f, -0.42f, -0.13f}, {0.9f, 0.2f, 0.1f})
        .quad({-0.7f, 0.11f, 0.63f}, {0.83f, 0.37f, 0.91f}, {0.97f, 0.52f, -0.57f}, {-0.63f, 0.29f, -0.81f},
              {0.2f, 0.8f, 0.3f})
        .quad({0.13f, -0.9f, -0.41f}, {0.31f, -0.87f, 0.77f}, {0.42f, 0.53f, 0.69f}, {0.19f, 0.49f, -0.53f},
              {0.1f, 0.3f, 0.7f})
        .triangle({0.71f, -0.731f, -0.72f}, {0.723f, -0.725f, -0.716f}, {0.718f, -0.711f, -0.713f}, {0.6f, 0.5f, 0.4f});
    made.material().emission = {2, 1, 0.5f};
    return made.scene;
}

struct Mean {
    int fragments = 0, borderline = 0;
    glm::dvec3 albedo{0}, normal{0}, emission{0};
};

/// The fragments of each voxel: every triangle that overlaps it counts once.
std::vector<Mean> means_of(const Scene& scene) {
    OverlapOracle oracle(scene, k_resolution);
    std::vector<Mean> means(size_t(k_resolution) * k_resolution * k_resolution);
    SceneState state = evaluate_scene(scene, 0, 0);
    for (const Instance& instance : state.instances) {
        const Material& material = scene.materials[size_t(instance.primitive.material)];
        for (uint32_t i = 0; i + 2 < instance.primitive.index_count; i += 3) {
            std::array<glm::dvec3, 3> p;
            glm::dvec3 low(1e9), high(-1e9);
            for (uint32_t k = 0; k < 3; ++k) {
                const Vertex& v = scene.vertices[scene.indices[instance.primitive.first_index + i + k]];
                p[k] = (glm::dvec3(instance.world * glm::vec4(v.position, 1)) - oracle.origin) *
                       (k_resolution / oracle.side);
                low = glm::min(low, p[k]), high = glm::max(high, p[k]);
            }
            glm::dvec3 normal(
                scene.vertices[scene.indices[instance.primitive.first_index + i]].normal); // all three are the same
            for (int z = int(low.z) - 1; z <= int(high.z) + 1; ++z)
                for (int y = int(low.y) - 1; y <= int(high.y) + 1; ++y)
                    for (int x = int(low.x) - 1; x <= int(high.x) + 1; ++x) {
                        if (glm::any(glm::lessThan(glm::ivec3(x, y, z), glm::ivec3(0))) ||
                            glm::any(glm::greaterThanEqual(glm::ivec3(x, y, z), glm::ivec3(k_resolution))))
                            continue;
                        double gap = separation(p, {x, y, z});
                        Mean& mean = means[size_t(x + k_resolution * (y + k_resolution * z))];
                        if (std::abs(gap) < 1e-4) ++mean.borderline;
                        if (gap > 0) continue;
                        ++mean.fragments;
                        mean.albedo += glm::dvec3(material.base_colour);
                        mean.normal += normal;
                        mean.emission += glm::dvec3(material.emission);
                    }
        }
    }
    for (Mean& mean : means) {
        double share = mean.fragments ? 1.0 / mean.fragments : 0;
        mean.albedo *= share, mean.normal *= share, mean.emission *= share;
    }
    return means;
}

class Voxelization : public SceneGraphTest {
  protected:
    /// Compares with the means, apart from voxels that a triangle just touches.
    void expect_means(const std::string& averaging, double tolerance, double emission_tolerance) {
        Scene scene = slanted();
        SceneRunner run(scene, {}, graph_file(k_graph), {{"voxelization.averaging", averaging}});
        run.frame();
        std::vector<float> albedo = run.read("voxels.albedo"), normal = run.read("voxels.normal"),
                           emission = run.read("voxels.emission");
        std::vector<Mean> means = means_of(scene);
        int occupied = 0, shared = 0;
        for (size_t i = 0; i < means.size(); ++i) {
            const Mean& mean = means[i];
            if (mean.borderline) continue;
            ASSERT_EQ(albedo[4 * i + 3] > 0, mean.fragments > 0) << averaging << ", voxel " << i;
            if (!mean.fragments) continue;
            ++occupied;
            shared += mean.fragments > 1;
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(albedo[4 * i + size_t(k)], mean.albedo[k], tolerance) << averaging << ", voxel " << i;
                EXPECT_NEAR(normal[4 * i + size_t(k)], mean.normal[k], 2 * tolerance + 0.005) << averaging;
                EXPECT_NEAR(emission[4 * i + size_t(k)], mean.emission[k], emission_tolerance) << averaging;
            }
        }
        EXPECT_GT(occupied, 1000);
        EXPECT_GT(shared, 100);
    }
};

} // namespace

TEST_F(Voxelization, SumsAreTheMeansOfAllFragments) {
    expect_means("sum", 0.003, 0.002);
}

TEST_F(Voxelization, GathersAreTheMeansOfAllFragments) {
    expect_means("gather", 0.003, 0.002);
}

/// Eight bits, rounded at each step: off by a few of 255.
TEST_F(Voxelization, RunningAveragesAreTheMeansUpToTheirRounding) {
    expect_means("average", 4.0 / 255, 8.0 / 255);
}

TEST_F(Voxelization, LastWritersAreOneOfTheFragments) {
    Scene scene = slanted();
    SceneRunner run(scene, {}, graph_file(k_graph), {{"voxelization.averaging", "last_writer"}});
    run.frame();
    std::vector<float> albedo = run.read("voxels.albedo");
    std::vector<Mean> means = means_of(scene);
    int occupied = 0;
    for (size_t i = 0; i < means.size(); ++i) {
        if (means[i].borderline) continue;
        ASSERT_EQ(albedo[4 * i + 3] > 0, means[i].fragments > 0) << "voxel " << i;
        if (!means[i].fragments) continue;
        ++occupied;
        bool known = false;
        for (const Material& m : scene.materials)
            known = known || glm::length(glm::vec3(m.base_colour) -
                                         glm::vec3(albedo[4 * i], albedo[4 * i + 1], albedo[4 * i + 2])) < 0.01f;
        EXPECT_TRUE(known) << "voxel " << i << " is torn between materials";
    }
    EXPECT_GT(occupied, 1000);
}

namespace {

/// Triangles of all colours through each other: most voxels hold several.
Scene crowd() {
    MadeScene made;
    uint32_t state = 7;
    auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return float(state >> 8) / float(1 << 24);
    };
    auto point = [&](float scale) { return scale * (2.0f * glm::vec3(next(), next(), next()) - 1.0f); };
    for (int i = 0; i < 400; ++i) {
        glm::vec3 a = point(0.7f);
        made.triangle(a, a + point(0.3f), a + point(0.3f), glm::vec3(next(), next(), next()));
    }
    made.material().emission = {2, 1, 0.5f};
    return made.scene;
}

/// The same triangles, the last one first.
Scene backwards(Scene scene) {
    auto& primitives = scene.meshes[0].primitives;
    std::reverse(primitives.begin(), primitives.end());
    for (const Primitive& primitive : primitives) {
        auto first = scene.indices.begin() + std::ptrdiff_t(primitive.first_index);
        for (uint32_t low = 0, high = primitive.index_count / 3; low + 1 < high--; ++low)
            std::swap_ranges(first + 3 * low, first + 3 * low + 3, first + 3 * high);
    }
    return scene;
}

} // namespace

/// Order dependence: the voxels that differ when the triangles come in the opposite order. A running mean is rounded at
/// each step; sums are not.
TEST_F(Voxelization, SumsAndGathersDoNotDependOnTheOrder) {
    for (const char* route : {"compute", "raster"}) {
        std::vector<std::vector<float>> sums;
        for (const char* averaging : {"sum", "gather", "average", "last_writer"}) {
            std::vector<std::vector<float>> volumes[3]; // the third: the first once more
            for (int turn = 0; turn < 3; ++turn) {
                SceneRunner run(turn == 1 ? backwards(crowd()) : crowd(), {}, graph_file(k_graph),
                                {{"voxelization.averaging", averaging}, {"voxelization.route", route}});
                run.frame();
                for (const char* name : {"voxels.albedo", "voxels.normal", "voxels.emission", "voxels.flags"})
                    volumes[turn].push_back(run.read(name));
            }
            int occupied = 0, differ = 0, again = 0;
            float most = 0;
            for (size_t i = 0; i < volumes[0][3].size(); ++i) {
                float here = 0;
                for (size_t k = 0; k < 4; ++k)
                    here = std::max(here, std::abs(volumes[0][0][4 * i + k] - volumes[1][0][4 * i + k]));
                occupied += volumes[0][0][4 * i + 3] > 0;
                differ += here > 0;
                for (size_t k = 0; k < 3; ++k)
                    if (volumes[0][0][4 * i + k] != volumes[2][0][4 * i + k]) {
                        ++again;
                        break;
                    }
                most = std::max(most, here);
            }
            fmt::print(
                "    {:<8} {:<12} {} of {} voxels differ in albedo, by {:.1f} / 255 at most; in a second run {}\n",
                route, averaging, differ, occupied, 255 * most, again);
            ASSERT_GT(occupied, 1000);
            if (averaging == std::string("sum") || averaging == std::string("gather")) {
                EXPECT_EQ(volumes[0], volumes[1]) << route << ", " << averaging;
                EXPECT_EQ(volumes[0], volumes[2]) << route << ", " << averaging;
            } else if (averaging == std::string("average")) {
                EXPECT_GT(differ, 0) << route;
                EXPECT_LT(most, 4.0f / 255) << route;
            } else {
                EXPECT_GT(most, 0.1f) << route; // another surface altogether
            }
            if (averaging == std::string("sum")) sums = volumes[0];
            // The compute route marks what overlaps exactly, and there the owner of a voxel finds the same fragments.
            if (averaging == std::string("gather") && route == std::string("compute")) {
                EXPECT_EQ(volumes[0], sums);
            }
        }
    }
}

/// Where all fragments of a voxel lie in one plane, its offset is that plane's: a step of eight bits beside the
/// normal's own rounding. Voxels without planes say 1.
TEST_F(Voxelization, KnowsWhereItsPlaneLies) {
    Scene scene =
        MadeScene()
            .quad({-0.9f, -0.31f, 0.83f}, {0.87f, 0.12f, 0.91f}, {0.93f, 0.27f, -0.88f}, {-0.84f, -0.16f, -0.96f})
            .scene;
    const Primitive& primitive = scene.meshes[0].primitives[0];
    OverlapOracle oracle(scene, k_resolution);
    std::array<glm::dvec3, 2> from, normals;
    for (size_t t = 0; t < 2; ++t) {
        std::array<glm::dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = (glm::dvec3(scene.vertices[scene.indices[primitive.first_index + 3 * t + k]].position) -
                    oracle.origin) *
                   (k_resolution / oracle.side);
        from[t] = p[0], normals[t] = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    for (const char* averaging : {"sum", "gather", "last_writer"}) {
        SceneRunner run(scene, {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph),
                        {{"voxelization.averaging", averaging}, {"voxelization.planes", "true"}});
        run.frame();
        std::vector<float> normal = run.read("voxels.normal"), albedo = run.read("voxels.albedo");
        int known = 0;
        for (size_t i = 0; i < oracle.separations.size(); ++i) {
            if (albedo[4 * i + 3] <= 0) continue;
            glm::dvec3 centre = glm::dvec3(oracle.voxel_of(i)) + 0.5;
            double a = glm::dot(normals[0], from[0] - centre), b = glm::dot(normals[1], from[1] - centre);
            double got = normal[4 * i + 3];
            EXPECT_GE(got, std::min(a, b) - 0.02) << averaging << ", voxel " << i;
            EXPECT_LE(got, std::max(a, b) + 0.02) << averaging << ", voxel " << i;
            ++known;
        }
        EXPECT_GT(known, 800);
    }
    SceneRunner plain(scene, {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph),
                      {{"voxelization.averaging", "sum"}});
    plain.frame();
    std::vector<float> normal = plain.read("voxels.normal"), albedo = plain.read("voxels.albedo");
    for (size_t i = 0; i < albedo.size(); i += 4)
        if (albedo[i + 3] > 0) {
            EXPECT_EQ(normal[i + 3], 1.0f);
        }
}

/// An emissive strip on a wall, 4, 2, 1 and ½ voxels wide: the light that its voxels send out is L·A, when each sends
/// it from its plane's area (here a voxel's face). Means over triangles lose or gain, by what else lies in the voxel.
TEST_F(Voxelization, KeepsTheLightOfStripsThinnerThanAVoxel) {
    const double voxel = 2.0 * (1 + 2.0 / k_resolution) / k_resolution;
    for (double width : {4.0, 2.0, 1.0, 0.5}) {
        float low = -0.137f, high = low + float(width * voxel), bottom = -0.52f, top = 0.61f, z = -0.99f;
        MadeScene made;
        made.box({-1, -1, -1}, {1, 1, 1}, {0.5f, 0.5f, 0.5f}, true)
            .quad({low, bottom, z}, {high, bottom, z}, {high, top, z}, {low, top, z}, {0, 0, 0});
        made.material().emission = {4, 2, 1};
        double wanted = 4.0 * double(high - low) * double(top - bottom);
        std::map<std::string, double> got;
        for (const char* share : {"mean", "covered", "gathered"}) {
            bool gathered = share == std::string("gathered");
            SceneRunner run(made.scene, {}, graph_file(k_graph),
                            {{"voxelization.averaging", gathered ? "gather" : "sum"},
                             {"voxelization.planes", "true"},
                             {"voxelization.emission_share", gathered ? "covered" : share}});
            run.frame();
            std::vector<float> emission = run.read("voxels.emission");
            double sum = 0;
            for (size_t i = 0; i < emission.size(); i += 4)
                sum += emission[i] * voxel * voxel;
            got[share] = sum / wanted;
        }
        fmt::print("    {} voxels: {:.3f} of the light by means, {:.3f} by the covered share\n", width, got["mean"],
                   got["covered"]);
        EXPECT_EQ(got["gathered"], got["covered"]);
        EXPECT_NEAR(got["covered"], 1, 0.02) << width << " voxels"; // rounding of area·L to 1/32767, rgba16f
    }
}

TEST_F(Voxelization, ListsEachOccupiedVoxelOnce) {
    SceneRunner run(slanted(), {}, graph_file(k_graph), {{"voxelization.averaging", "sum"}});
    run.frame();
    std::vector<float> albedo = run.read("voxels.albedo");
    std::vector<uint32_t> counts = run.read_buffer<uint32_t>("voxels.counts");
    std::vector<uint32_t> list = run.read_buffer<uint32_t>("voxels.list");
    uint32_t listed = counts[3];
    ASSERT_LE(listed, list.size());
    std::set<uint32_t> entries(list.begin(), list.begin() + listed);
    EXPECT_EQ(entries.size(), listed);
    size_t occupied = 0;
    for (size_t i = 0; i < albedo.size(); i += 4)
        occupied += albedo[i + 3] > 0;
    EXPECT_EQ(occupied, listed);
    EXPECT_EQ(counts[5], 0u);
}

/// What moves is cleared and voxelized anew; what does not is left alone, until it changes.
TEST_F(Voxelization, FollowsDynamicGeometryAndStaticChanges) {
    MadeScene made;
    made.quad({-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}, {0.8f, 0.8f, 0.8f})
        .quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, {0.3f, 0.3f, 0.3f})
        .box({-0.4f, -0.3f, -0.2f}, {-0.1f, 0.1f, 0.2f}, {0.9f, 0.2f, 0.1f});
    for (const char* averaging : {"average", "last_writer", "sum", "gather"}) {
        auto moved = [&](SceneRunner& run, float by) {
            for (size_t i = 2; i < run.state.instances.size(); ++i) {
                run.state.instances[i].dynamic = true;
                run.state.instances[i].world[3].x = by;
            }
            run.facts.dynamic_instances = run.state.instances.size() - 2;
        };
        SceneRunner run(made.scene, {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph),
                        {{"voxelization.averaging", averaging}});
        moved(run, 0);
        run.frame();
        moved(run, 0.37f);
        run.frame();
        SceneRunner fresh(made.scene, {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph),
                          {{"voxelization.averaging", averaging}});
        moved(fresh, 0.37f);
        fresh.frame();
        EXPECT_EQ(run.read("voxels.albedo"), fresh.read("voxels.albedo")) << averaging;
        EXPECT_EQ(run.read("voxels.normal"), fresh.read("voxels.normal")) << averaging;
        EXPECT_EQ(run.read("voxels.flags"), fresh.read("voxels.flags")) << averaging;
        std::vector<uint32_t> counts = run.read_buffer<uint32_t>("voxels.counts");
        EXPECT_GT(counts[4], 0u);
        EXPECT_GT(counts[3], counts[4]) << "dynamic voxels follow the static ones";

        // A static instance moves after all.
        for (SceneRunner* one : {&run, &fresh})
            one->state.instances[1].world[3].y = -0.6f;
        run.frame();
        SceneRunner again(made.scene, {directional_light({0, -1, 0}, {1, 1, 1})}, graph_file(k_graph),
                          {{"voxelization.averaging", averaging}});
        moved(again, 0.37f);
        again.state.instances[1].world[3].y = -0.6f;
        again.frame();
        EXPECT_EQ(run.read("voxels.albedo"), again.read("voxels.albedo")) << averaging;
    }
}

namespace {

/// Counts against exact overlap: voxels missing, extra, and how far the farthest extra one lies from any triangle.
struct Against {
    int occupied = 0, missing = 0, extra = 0;
    double farthest = 0;
};
Against against_overlap(const Scene& scene, const std::vector<float>& albedo) {
    OverlapOracle oracle(scene, k_resolution);
    Against result;
    for (size_t i = 0; i < oracle.separations.size(); ++i) {
        double gap = oracle.separations[i];
        bool set = albedo[4 * i + 3] > 0;
        if (std::abs(gap) < OverlapCount::k_border) continue;
        result.occupied += gap < 0;
        result.missing += gap < 0 && !set;
        if (gap > 0 && set) {
            ++result.extra;
            // Farther voxels are not weighed by the oracle: they count as very far.
            result.farthest = std::max(result.farthest, gap);
        }
    }
    return result;
}

} // namespace

TEST_F(Voxelization, ByRasterWithExactFillIsExactOverlap) {
    Scene scene = slanted();
    SceneRunner run(
        scene, {}, graph_file(k_graph),
        {{"voxelization.route", "raster"}, {"voxelization.fill", "exact"}, {"voxelization.averaging", "sum"}});
    run.frame();
    Against result = against_overlap(scene, run.read("voxels.albedo"));
    EXPECT_GT(result.occupied, 1000);
    EXPECT_EQ(result.missing, 0);
    EXPECT_EQ(result.extra, 0);
}

/// As published: each column that a triangle touches has a voxel; none lies farther than the dilation of half a pixel
/// and the column's slope allow.
TEST_F(Voxelization, ByRasterAsPublishedHasAVoxelInEachColumnAndNoneFar) {
    Scene scene = slanted();
    SceneRunner run(scene, {}, graph_file(k_graph), {{"voxelization.route", "raster"}});
    run.frame();
    std::vector<float> albedo = run.read("voxels.albedo");
    Against result = against_overlap(scene, albedo);
    fmt::print("    {} of {} voxels missing, {} extra, the farthest {:.3f} voxels away\n", result.missing,
               result.occupied, result.extra, result.farthest);
    EXPECT_LT(result.farthest, 1.0);
    EXPECT_LT(result.missing, 0.6 * result.occupied);
    // Every voxel that the exact route has, has a neighbour of this route within one voxel.
    OverlapOracle oracle(scene, k_resolution);
    for (size_t i = 0; i < oracle.separations.size(); ++i) {
        if (oracle.separations[i] > -OverlapCount::k_border) continue;
        glm::ivec3 at = oracle.voxel_of(i);
        bool near = false;
        for (int k = 0; k < 27 && !near; ++k) {
            glm::ivec3 p = at + glm::ivec3(k % 3, k / 3 % 3, k / 9) - 1;
            if (glm::any(glm::lessThan(p, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(p, glm::ivec3(k_resolution))))
                continue;
            near = albedo[4 * size_t(p.x + k_resolution * (p.y + k_resolution * p.z)) + 3] > 0;
        }
        EXPECT_TRUE(near) << at.x << " " << at.y << " " << at.z;
    }
}
