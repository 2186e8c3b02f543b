// The light of proxies against closed forms, and of cells against sums over their proxies.
#include "support/harmonics.h"
#include "vf/vf_fixture.h"

#include <cmath>

using namespace bounce;

namespace {

class VfCells : public VfTest {
  protected:
    std::vector<VfProxyLight> lights() const { return run->read_buffer<VfProxyLight>("vf.light"); }
};

} // namespace

TEST_F(VfCells, ProxiesSendOnWhatTheLightSendsThem) {
    Light light = point_light({0.4f, 1.5f, 0.2f}, {3, 4, 5});
    Scene scene = MadeScene().quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.8f, 0.4f, 0.2f}).scene;
    make(scene, {light}, {});
    std::vector<VfProxy> all = entries();
    std::vector<VfProxyLight> lit = lights();
    for (size_t i = 0; i < all.size(); ++i) {
        glm::dvec3 to = glm::dvec3(light.position) - glm::dvec3(all[i].position);
        double expected = 0.4 * 4 * to.y / std::pow(glm::length(to), 3) / M_PI * double(all[i].area);
        EXPECT_NEAR(lit[i].front.g, expected, 1e-4 * expected);
        EXPECT_EQ(lit[i].back.g, 0) << "no light comes from below";
    }
}

/// A light below a thin sheet lights its other side.
TEST_F(VfCells, EachSideKeepsItsOwnLight) {
    Scene scene = MadeScene().quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}).scene;
    make(scene, {directional_light({0, -1, 0}, {2, 2, 2}), directional_light({0, 1, 0}, {6, 6, 6})}, {});
    std::vector<VfProxy> all = entries();
    std::vector<VfProxyLight> lit = lights();
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(lit[i].front.r, 0.5 * 2 / M_PI * double(all[i].area), 1e-4);
        EXPECT_NEAR(lit[i].back.r, 0.5 * 6 / M_PI * double(all[i].area), 1e-4);
    }
}

TEST_F(VfCells, ShadowsReachTheProxies) {
    make(blocks(), {directional_light({0, -1, 0}, {1, 1, 1})}, {});
    std::vector<VfProxy> all = entries();
    std::vector<VfProxyLight> lit = lights();
    int dark = 0, bright = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        glm::vec3 p = all[i].position;
        if (std::abs(p.y) > 1e-4f) continue; // the floor, under the slab and beside everything
        if (p.x > -0.88f && p.x < -0.22f && p.z > -0.58f && p.z < 0.48f) {
            EXPECT_EQ(lit[i].front.r, 0);
            ++dark;
        } else if (p.x > 1 && p.z > 0) {
            EXPECT_GT(lit[i].front.r, 0);
            ++bright;
        }
    }
    EXPECT_GT(dark, 5);
    EXPECT_GT(bright, 5);
}

/// Coefficients against integrals of the lobes' sum, and the centroid.
TEST_F(VfCells, HoldTheSphericalHarmonicsOfTheirProxies) {
    make(blocks(), light_above_blocks(), {{"vf_proxies.cells", "3"}});
    VfGrid g = grid();
    std::vector<VfProxy> all = entries();
    std::vector<VfProxyLight> lit = lights();
    std::vector<glm::uvec2> range = ranges();
    std::vector<VfCell> cells = run->read_buffer<VfCell>("vf.cells");
    ASSERT_EQ(cells.size(), size_t(g.count));
    int full = 0;
    for (int c = 0; c < g.count; ++c) {
        double weight = 0, area = 0;
        glm::dvec3 centre(0);
        std::vector<std::pair<glm::dvec3, double>> lobes; // of red
        for (uint32_t i = range[size_t(2 * c)].x; i < range[size_t(2 * c)].y; ++i) {
            glm::dvec3 light = glm::dvec3(lit[i].front) + glm::dvec3(lit[i].back);
            double bright = glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722));
            centre += bright * glm::dvec3(all[i].position);
            weight += bright;
            area += double(all[i].area);
            lobes.push_back({glm::dvec3(all[i].normal), lit[i].front.r});
            lobes.push_back({-glm::dvec3(all[i].normal), lit[i].back.r});
        }
        EXPECT_EQ(cells[size_t(c)].c00.a > 0, weight > 0);
        EXPECT_NEAR(cells[size_t(c)].middle.w, area, 1e-4);
        if (weight == 0) continue;
        EXPECT_LT(glm::length(glm::dvec3(cells[size_t(c)].middle) - centre / weight), 1e-4);
        if (full++ > 3) continue; // integrals take their time
        auto intensity = [&](glm::dvec3 d) {
            double sum = 0;
            for (const auto& [n, light] : lobes)
                if (light > 0) sum += light * std::max(glm::dot(n, d), 0.0);
            return sum;
        };
        double c00 = project_on_harmonic(intensity, -1);
        EXPECT_NEAR(cells[size_t(c)].c00.r, c00, 2e-3 * c00);
        for (int m = 0; m < 3; ++m)
            EXPECT_NEAR(cells[size_t(c)].c1[m].r, project_on_harmonic(intensity, m), 2e-3 * c00);
    }
    EXPECT_GT(full, 4);
}
