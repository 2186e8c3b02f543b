// Point proxies: where they lie, how many there are, what they stand for, and in which cells they are found.
#include "vf/vf_fixture.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <set>

using namespace bounce;

namespace {

class VfProxies : public VfTest {};

struct Corners {
    glm::dvec3 a, b, c;
    glm::dvec3 normal() const { return glm::normalize(glm::cross(b - a, c - a)); }
    double area() const { return 0.5 * glm::length(glm::cross(b - a, c - a)); }
};

std::vector<Corners> corners_of(const Scene& scene) {
    std::vector<Corners> all;
    for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
        auto at = [&](size_t k) { return glm::dvec3(scene.vertices[scene.indices[i + k]].position); };
        all.push_back({at(0), at(1), at(2)});
    }
    return all;
}

double area_of(const Scene& scene) {
    double sum = 0;
    for (const Corners& triangle : corners_of(scene))
        sum += triangle.area();
    return sum;
}

/// How far p lies beside the triangle or off its plane.
double distance_to(const Corners& t, glm::dvec3 p) {
    glm::dvec3 e1 = t.b - t.a, e2 = t.c - t.a, d = p - t.a;
    double off = std::abs(glm::dot(t.normal(), d));
    double d11 = glm::dot(e1, e1), d12 = glm::dot(e1, e2), d22 = glm::dot(e2, e2), det = d11 * d22 - d12 * d12;
    double u = (d22 * glm::dot(d, e1) - d12 * glm::dot(d, e2)) / det;
    double v = (d11 * glm::dot(d, e2) - d12 * glm::dot(d, e1)) / det;
    return std::max({off, -u, -v, u + v - 1});
}

/// 40 × 40 quads, each of two triangles that are worth less than one proxy.
Scene many_small() {
    MadeScene made;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
            float l = float(x) / 20 - 1, b = float(y) / 20 - 1;
            made.quad({l, 0, b + 0.05f}, {l + 0.05f, 0, b + 0.05f}, {l + 0.05f, 0, b}, {l, 0, b});
        }
    return made.scene;
}

} // namespace

TEST_F(VfProxies, LieOnTheirTrianglesAndStandForTheirArea) {
    make(blocks(), light_above_blocks(), {});
    std::vector<Corners> triangles = corners_of(run->scene);
    double total = area_of(run->scene), sum = 0;
    std::vector<double> covered(triangles.size());
    // The block's underside lies in the floor: normals tell them apart.
    auto off = [&](size_t i, const VfProxy& proxy) {
        return distance_to(triangles[i], proxy.position) +
               (glm::dot(triangles[i].normal(), glm::dvec3(proxy.normal)) > 0.9 ? 0 : 1e-2);
    };
    for (const VfProxy& proxy : proxies()) {
        size_t best = 0;
        for (size_t i = 0; i < triangles.size(); ++i)
            if (off(i, proxy) < off(best, proxy)) best = i;
        EXPECT_LT(distance_to(triangles[best], proxy.position), 1e-5);
        EXPECT_GT(glm::dot(triangles[best].normal(), glm::dvec3(proxy.normal)), 0.9999);
        EXPECT_NEAR(proxy.radius, std::sqrt(proxy.area / M_PI), 1e-5);
        covered[best] += proxy.area;
        sum += proxy.area;
    }
    VfGrid g = grid();
    EXPECT_NEAR(g.area, total, 1e-4 * total);
    EXPECT_EQ(g.asked, 600u);
    EXPECT_EQ(g.used, 600u);
    EXPECT_EQ(g.dropped, 0u);
    EXPECT_EQ(g.outside, 0u);
    EXPECT_EQ(proxies().size(), g.proxies);
    // A triangle worth at least one proxy has exactly its area; the others have it in the mean.
    double variance = 0, deviation = 0;
    for (size_t i = 0; i < triangles.size(); ++i) {
        double wanted = triangles[i].area() * double(g.density), fraction = wanted - std::floor(wanted);
        variance += fraction * (1 - fraction);
        if (wanted < 1) {
            deviation += fraction * (1 - fraction) / std::pow(double(g.density), 2);
            continue;
        }
        EXPECT_NEAR(covered[i], triangles[i].area(), 1e-4 * total) << i;
    }
    EXPECT_NEAR(double(g.proxies), 600, 3 * std::sqrt(variance) + 1);
    EXPECT_NEAR(sum, total, 3 * std::sqrt(deviation) + 1e-4 * total);
}

TEST_F(VfProxies, OfSmallTrianglesAreDrawnByRoulette) {
    make(many_small(), {directional_light({0, -1, 0}, {1, 1, 1})}, {{"vf_proxies.proxies", "960"}});
    double chance = 960.0 / 3200; // of each triangle
    std::vector<VfProxy> all = proxies();
    EXPECT_NEAR(double(all.size()), 960, 3 * std::sqrt(3200 * chance * (1 - chance)));
    double sum = 0;
    for (const VfProxy& proxy : all)
        sum += proxy.area;
    EXPECT_NEAR(sum, 4, 4 * 3 * std::sqrt((1 - chance) / (chance * 3200)));
    // No part of the square gets more than its share: quarters.
    int quarters[4] = {};
    for (const VfProxy& proxy : all)
        ++quarters[(proxy.position.x > 0 ? 1 : 0) + (proxy.position.z > 0 ? 2 : 0)];
    for (int count : quarters)
        EXPECT_NEAR(count, 240, 3 * std::sqrt(800 * chance * (1 - chance)));
}

TEST_F(VfProxies, AreLeftOutWhereAlphaCutsTheSurfaceAway) {
    for (bool by_texture : {false, true}) {
        make(half_transparent(by_texture), {directional_light({0, -1, 0}, {1, 1, 1})}, {});
        std::vector<VfProxy> all = proxies();
        EXPECT_EQ(all.size() + grid().cut_away, grid().proxies);
        EXPECT_NEAR(double(all.size()), 300, 30);
        int wrong = 0; // mips blur the edge of a texture
        for (const VfProxy& proxy : all)
            wrong += proxy.position.x < (by_texture ? -0.05f : -0.01f) ? 1 : 0;
        EXPECT_LE(wrong, 0) << by_texture;
    }
}

/// What moves takes its proxies along: the same places on the object.
TEST_F(VfProxies, MoveWithTheirObjects) {
    make(blocks(), light_above_blocks(), {{"vf_proxies.cells", "1"}});
    std::vector<VfProxy> before = proxies();
    glm::mat4 moved(1);
    moved[3] = glm::vec4(0.01f, -0.005f, 0.007f, 1);
    for (Instance& instance : run->state.instances)
        instance.world = moved * instance.world;
    run->frame();
    std::vector<VfProxy> after = proxies();
    ASSERT_GT(after.size(), 500u);
    size_t same = 0;
    for (const VfProxy& proxy : after)
        for (const VfProxy& old : before)
            if (glm::length(proxy.position - old.position - glm::vec3(moved[3])) < 1e-5f) {
                ++same;
                break;
            }
    EXPECT_EQ(same, after.size()) << "but for those that left the grid";
}

TEST_F(VfProxies, AreSortedByCells) {
    for (const char* cells : {"1", "4", "9"}) {
        make(blocks(), light_above_blocks(), {{"vf_proxies.cells", cells}});
        VfGrid g = grid();
        std::vector<VfProxy> all = entries();
        std::vector<glm::uvec2> range = ranges();
        ASSERT_GE(range.size(), size_t(2 * g.count));
        size_t found = 0;
        for (int c = 0; c < g.count; ++c) {
            EXPECT_EQ(range[size_t(2 * c) + 1].x, range[size_t(2 * c) + 1].y) << "a copy";
            for (uint32_t i = range[size_t(2 * c)].x; i < range[size_t(2 * c)].y; ++i) {
                ASSERT_LT(i, all.size());
                EXPECT_EQ(all[i].cell, uint32_t(c));
                EXPECT_EQ(index_of(g, cell_at(g, all[i].position)), c);
                ++found;
            }
        }
        EXPECT_EQ(found, all.size());
        EXPECT_EQ(all.size(), g.proxies);
    }
}

/// With overlap a disc is found in every cell that the box around it reaches into, once, and counts in its own only.
TEST_F(VfProxies, AreFoundWhereTheirDiscsReach) {
    make(blocks(), light_above_blocks(), {{"vf_proxies.overlap", "true"}, {"vf_proxies.disc_scale", "4"}});
    VfGrid g = grid();
    std::vector<VfProxy> all = entries();
    std::vector<glm::uvec2> range = ranges();
    using Key = std::array<float, 3>;
    auto key = [](const VfProxy& proxy) { return Key{proxy.position.x, proxy.position.y, proxy.position.z}; };
    std::map<Key, std::multiset<int>> got, expected;
    size_t own = 0;
    for (int c = 0; c < g.count; ++c) {
        for (int copies : {0, 1}) {
            glm::uvec2 r = range[size_t(2 * c + copies)];
            for (uint32_t i = r.x; i < r.y; ++i) {
                got[key(all[i])].insert(c);
                EXPECT_EQ(all[i].area > 0, copies == 0);
                EXPECT_EQ(all[i].cell == uint32_t(c), copies == 0);
                own += copies == 0 ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(own, g.proxies);
    EXPECT_GT(all.size(), own);
    int unsure = 0;
    for (const VfProxy& proxy : proxies()) {
        glm::vec3 reach = proxy.radius * glm::sqrt(glm::max(1.0f - proxy.normal * proxy.normal, 0.0f));
        for (float slack : {1e-5f, -1e-5f}) { // a box that touches a wall of a cell may go either way
            glm::ivec3 low = glm::clamp(cell_at(g, proxy.position - reach - slack), glm::ivec3(0), g.size - 1);
            glm::ivec3 high = glm::clamp(cell_at(g, proxy.position + reach + slack), glm::ivec3(0), g.size - 1);
            std::multiset<int> cells;
            for (int z = low.z; z <= high.z; ++z)
                for (int y = low.y; y <= high.y; ++y)
                    for (int x = low.x; x <= high.x; ++x)
                        cells.insert(index_of(g, {x, y, z}));
            if (slack > 0)
                expected[key(proxy)] = cells;
            else if (cells != expected[key(proxy)])
                ++unsure, expected.erase(key(proxy)), got.erase(key(proxy));
        }
    }
    EXPECT_LT(unsure, 20);
    EXPECT_EQ(got, expected);
}

/// The same bytes in every run: nothing depends on the order of execution.
TEST_F(VfProxies, AreTheSameBytesInEveryRun) {
    std::vector<std::vector<uint8_t>> runs;
    for (int k = 0; k < 2; ++k) {
        make(blocks(), light_above_blocks(), {{"vf_proxies.overlap", "true"}});
        runs.push_back(run->read_buffer<uint8_t>("vf.proxies"));
        run->graph.touch();
        run->frame();
        runs.push_back(run->read_buffer<uint8_t>("vf.proxies"));
    }
    for (const auto& bytes : runs)
        EXPECT_EQ(bytes, runs[0]);
}

/// More proxies than cells can tell apart are not made.
TEST_F(VfProxies, AreNoMoreThanTheSceneNeeds) {
    make(blocks(), light_above_blocks(), {{"vf_proxies.proxies", "5000"}, {"vf_proxies.per_face", "8"}});
    VfGrid g = grid();
    glm::vec3 face(g.cell.x * g.cell.y, g.cell.y * g.cell.z, g.cell.z * g.cell.x);
    double needed = std::ceil(8 * area_of(run->scene) / ((face.x + face.y + face.z) / 3));
    ASSERT_LT(needed, 5000);
    EXPECT_NEAR(double(g.used), needed, 1);
    EXPECT_NEAR(double(g.proxies), needed, 30);
    EXPECT_EQ(g.asked, 5000u);
}
