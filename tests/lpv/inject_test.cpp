// Injection against the reflective shadow maps, the geometry volume against walls, and where the grid lies.
#include "lpv/lpv_fixture.h"
#include "lrsm/rsm_fixture.h"
#include "support/harmonics.h"

#include <cmath>

using namespace bounce;

namespace {

class LpvInject : public LpvTest {
  protected:
    static LpvSets one_iteration() { return {{"graph.iterations", "1"}, {"graph.cells", "16"}}; }

    struct Texel {
        glm::dvec3 position, normal, intensity;
    };
    /// The maps' texels as small Lambert sources.
    std::vector<Texel> texels() const {
        const ReflectiveShadowMaps maps(*run);
        std::vector<Texel> all;
        for (int v = 0; v < maps.size.z; ++v)
            for (int y = 0; y < maps.size.y; ++y)
                for (int x = 0; x < maps.size.x; ++x) {
                    const glm::dvec4 radiance = maps.radiance_at(v, x, y);
                    if (!maps.holds(v, x, y) || radiance.a <= 1e-3) continue;
                    const ShadowView& view = maps.views[size_t(v)];
                    const glm::dvec2 ndc = (glm::dvec2(x, y) + 0.5) / glm::dvec2(maps.size) * 2.0 - 1.0;
                    if (std::max(std::abs(ndc.x), std::abs(ndc.y)) > double(view.window)) continue;
                    const glm::dmat4 m(view.view_projection);
                    const glm::dvec3 right(m[0].x, m[1].x, m[2].x), up(m[0].y, m[1].y, m[2].y);
                    const glm::dvec3 across =
                        right * (ndc.x / glm::dot(right, right)) + up * (ndc.y / glm::dot(up, up));
                    const glm::dvec3 direction(view.direction), origin(view.origin);
                    const double along = maps.distance(v, x, y), side = view.texel_size;
                    double area = side * side;
                    glm::dvec3 position = origin + across + along * direction;
                    if (view.range == 0) {
                        area *= along * along / glm::length(direction + across);
                        position = origin + along * (direction + across);
                    }
                    all.push_back(
                        {position, glm::dvec3(maps.normal_at(v, x, y)), glm::dvec3(radiance) / radiance.a * area});
                }
        return all;
    }
    static glm::dvec3 total(const std::vector<Texel>& all) {
        glm::dvec3 sum(0);
        for (const Texel& texel : all)
            sum += texel.intensity;
        return sum;
    }
};

} // namespace

/// Of spots, points and the sun together: all light of the maps is in the grid, and its lobes have the flux πI.
TEST_F(LpvInject, CellsHoldTheFluxOfTheMaps) {
    make(blocks(), one_of_each(), one_iteration());
    const glm::dvec3 expected = total(texels());
    const double face = std::pow(double(grid().cascade[0].cell), 2);
    const std::vector<LpvLight> light = wave(0);
    for (int colour = 0; colour < 3; ++colour)
        EXPECT_NEAR(flux(light, colour) * face / expected[colour], 1, 1e-4);
    const std::vector<uint32_t> counts = run->read_buffer<uint32_t>("lpv.counts");
    EXPECT_GT(counts[0], 1000u);
    EXPECT_EQ(counts[1], 0u) << "the grid holds the scene";
}

/// A cell's coefficients against the integrals of its texels' clamped cosines, and each texel in the cell before it.
TEST_F(LpvInject, CoefficientsAreThoseOfClampedCosines) {
    make(blocks(), {spot_light({0.3f, 3, 0.2f}, {-0.1f, -1, 0.1f}, {9, 6, 3}, 20, 42)}, one_iteration());
    const LpvCascade cascade = grid().cascade[0];
    std::vector<std::vector<Texel>> by_cell(16 * 16 * 16);
    for (const Texel& texel : texels()) {
        const glm::dvec3 place =
            (texel.position - glm::dvec3(cascade.anchor)) / double(cascade.cell) + 0.5 * texel.normal;
        by_cell[size_t(index(glm::ivec3(glm::floor(place))))].push_back(texel);
    }
    const std::vector<LpvLight> light = wave(0);
    const double face = std::pow(double(cascade.cell), 2);
    int compared = 0, integrated = 0;
    for (size_t i = 0; i < by_cell.size(); ++i) {
        double level = 0;
        for (const Texel& texel : by_cell[i])
            level += std::sqrt(M_PI) / 2 * texel.intensity.g / face;
        if (by_cell[i].size() < 8) continue; // of few, one on the border would tell
        ++compared;
        EXPECT_NEAR(light[i][1].x, level, 0.15 * level) << i;
        if (integrated == 3 || std::abs(double(light[i][1].x) / level - 1) > 1e-4) continue;
        ++integrated;
        auto sent = [&](glm::dvec3 d) {
            double sum = 0;
            for (const Texel& texel : by_cell[i])
                sum += texel.intensity.g / face * std::max(glm::dot(texel.normal, d), 0.0);
            return sum;
        };
        for (int m = -1; m < 3; ++m)
            EXPECT_NEAR(light[i][1][m + 1], project_on_harmonic(sent, m), 2e-3 * level) << i << ", " << m;
    }
    EXPECT_GT(compared, 20);
    EXPECT_EQ(integrated, 3);
}

/// Blended in halves as published, cells hold the same light, but for what many small summands lose to rounding.
TEST_F(LpvInject, BlendingAddsUpTheSame) {
    LpvSets sets{{"graph.iterations", "1"}, {"graph.cells", "12"}, {"graph.cascades", "2"}};
    make(blocks(), one_of_each(), sets);
    const std::vector<LpvLight> sorted = wave(0);
    sets.push_back({"inject.route", "blended"});
    make(blocks(), one_of_each(), sets);
    const std::vector<LpvLight> blended = wave(0);
    ASSERT_EQ(sorted.size(), blended.size());
    double most = 0;
    for (const LpvLight& cell : sorted)
        most = std::max(most, double(cell[1].x));
    int lit = 0;
    for (size_t i = 0; i < sorted.size(); ++i) {
        lit += sorted[i][1].x > 0 ? 1 : 0;
        for (int colour = 0; colour < 3; ++colour)
            for (int k = 0; k < 4; ++k)
                EXPECT_NEAR(blended[i][colour][k], sorted[i][colour][k], 0.04 * sorted[i][colour].x + 1e-3 * most) << i;
    }
    EXPECT_GT(lit, 100);
    run->frame();
    EXPECT_EQ(wave(0), blended) << "points are blended in their order";
}

/// Where cells are coarse, half a cell along the normal leads through other surfaces. What the light sees, no surface
/// hides.
TEST_F(LpvInject, LightStartsInCellsThatTheLightSees) {
    const glm::dvec3 lamp(0.3, 3, 0.2);
    MadeScene made; // slats over a floor
    made.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    for (int i = 0; i < 12; ++i)
        made.box({-1.9f + 0.32f * float(i), 0.6f, -1.8f}, {-1.78f + 0.32f * float(i), 0.65f, 1.8f});
    std::vector<double> hidden;
    for (const char* start : {"shifted", "in_front", "lit"}) {
        make(made.scene, {spot_light(glm::vec3(lamp), {-0.1f, -1, 0.1f}, {9, 6, 3}, 20, 42)},
             {{"graph.iterations", "1"}, {"graph.cells", "8"}, {"rsm.resolution", "128"}, {"lights.start", start}});
        const LpvCascade cascade = grid().cascade[0];
        const std::vector<LpvLight> light = wave(0);
        double all = 0, dark = 0;
        for (int i = 0; i < 8 * 8 * 8; ++i) {
            if (light[size_t(i)][1].x <= 0) continue;
            const glm::dvec3 middle =
                glm::dvec3(cascade.anchor + cascade.cell * (glm::vec3(i % 8, i / 8 % 8, i / 64) + 0.5f));
            bool met = false;
            for (size_t t = 0; t + 2 < run->scene.indices.size() && !met; t += 3) {
                glm::dvec3 p[3];
                for (size_t k = 0; k < 3; ++k)
                    p[k] = glm::dvec3(run->scene.vertices[run->scene.indices[t + k]].position);
                met = crosses(p, lamp, middle - lamp) == 1;
            }
            all += double(light[size_t(i)][1].x);
            dark += met ? double(light[size_t(i)][1].x) : 0;
        }
        EXPECT_NEAR(all * std::pow(double(cascade.cell), 2) * 2 / std::sqrt(M_PI) / total(texels()).g, 1, 1e-3)
            << start;
        hidden.push_back(dark / all);
    }
    RecordProperty("hidden",
                   fmt::format("{:.3f} shifted, {:.3f} in front, {:.3f} lit", hidden[0], hidden[1], hidden[2]));
    EXPECT_GT(hidden[0], 0.1);
    EXPECT_LT(hidden[2], 0.25 * hidden[0]);
}

/// Ordinates hold the same flux: of each texel the sum over directions is what the lobe's integral is.
TEST_F(LpvInject, OrdinatesHoldTheFluxOfTheMaps) {
    shader("test/beams.comp", R"(#include "lpv/grid.glsl"
#include "lpv/ordinates.glsl"
layout(local_size_x = 64) in;
layout(std430) readonly buffer lpv_ordinates { uvec2 ordinates[]; };
layout(std430) writeonly buffer test_beams { vec4 beams[]; };
void main() {
    int m = int(gl_GlobalInvocationID.x), count = grid_cascades * cells_of_cascade();
    if (m >= directions) return;
    vec3 sum = vec3(0.0), size = abs(ordinate(m));
    for (int i = 0; i < count; ++i)
        sum += unpacked_light(ordinates[m * count + i]);
    beams[m] = vec4(sum * max(size.x, max(size.y, size.z)), 1.0);
}
)");
    Changes changes;
    changes.resources = R"("test.beams":{"kind":"buffer","count":"directions","stride":16},)";
    changes.removed = R"("sweep")";
    changes.passes = R"({"after":"inject_ordinates","id":"beams","type":"compute","shader":"test/beams.comp",
        "params_of":"inject_ordinates","dispatch":["directions"]})";
    make(blocks(), one_of_each(), {{"graph.angular", "ordinates"}, {"graph.cells", "16"}}, changes);
    const glm::dvec3 expected = total(texels()) * M_PI / std::pow(double(grid().cascade[0].cell), 2);
    const std::vector<glm::vec4> beams = run->read_buffer<glm::vec4>("test.beams");
    glm::dvec3 sum(0);
    for (const glm::vec4& beam : beams)
        sum += glm::dvec3(beam) * 4.0 * M_PI / double(beams.size());
    for (int colour = 0; colour < 3; ++colour)
        EXPECT_NEAR(sum[colour] / expected[colour], 1, 1e-4);
}

/// A wall that fills the cells of the geometry volume blocks there as a plane does, once however many views see it.
TEST_F(LpvInject, WallsFillTheGeometryVolume) {
    const Scene wall = MadeScene().quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}).scene;
    const Light sun = directional_light({0.1f, 0.05f, -1}, {2, 2, 2});
    for (const std::vector<Light>& lights : {std::vector<Light>{sun}, std::vector<Light>{sun, sun}}) {
        make(
            wall, lights,
            {{"graph.iterations", "1"}, {"graph.cells", "12"}, {"rsm.resolution", "256"}, {"surfels.pixel_rows", "0"}});
        const LpvCascade cascade = grid().cascade[0];
        const std::vector<glm::vec4> blockers = run->read_buffer<glm::vec4>("lpv.blocking");
        ASSERT_EQ(blockers.size(), 13u * 13 * 13);
        int full = 0;
        for (int i = 0; i < 13 * 13 * 13; ++i) {
            // The cells lie about corners.
            const glm::vec3 middle = cascade.anchor + cascade.cell * glm::vec3(i % 13, i / 13 % 13, i / 169);
            const float half = 0.5f * cascade.cell;
            if (std::abs(middle.z) > half * 0.99f || std::abs(middle.x) > 2 - half || std::abs(middle.y) > 2 - half)
                continue;
            ++full;
            EXPECT_NEAR(blockers[size_t(i)].w, 1, 0.15);
            EXPECT_NEAR(blockers[size_t(i)].z, blockers[size_t(i)].w, 1e-3);
        }
        EXPECT_GT(full, 50);
    }
}

/// The camera moves; the light of cells that both grids hold does not, to the bit.
TEST_F(LpvInject, CellsKeepTheirLightWhenTheCameraMoves) {
    LpvSets sets{{"graph.cells", "24"},     {"grid.follow", "true"},     {"grid.extent", "1"},
                 {"graph.iterations", "4"}, {"surfels.pixel_rows", "0"}, {"rsm.resolution", "128"}};
    make(blocks(), {spot_light({0.3f, 3, 0.2f}, {-0.1f, -1, 0.1f}, {9, 6, 3}, 20, 42)}, sets);
    const LpvGrid before = grid();
    const std::vector<LpvLight> light = run->read_buffer<LpvLight>("lpv.sum");
    bool moved = false, stood = false;
    for (float way : {0.03f, 0.5f, 1.3f}) {
        run->camera.position = glm::vec3(0.9f, 1.1f, 2.4f) + way * before.cascade[0].cell * glm::vec3(1, 0, 0);
        run->camera.target = run->camera.position + glm::vec3(-0.9f, -0.7f, -2.4f);
        run->frame();
        const LpvGrid after = grid();
        const glm::ivec3 by = after.cascade[0].base - before.cascade[0].base;
        (by == glm::ivec3(0) ? stood : moved) = true;
        const std::vector<LpvLight> now = run->read_buffer<LpvLight>("lpv.sum");
        int compared = 0;
        for (int i = 0; i < 24 * 24 * 24; ++i) {
            const glm::ivec3 at(i % 24, i / 24 % 24, i / 576), there = at - by;
            // What lies as near to the border as light goes may lack some.
            auto deep = [](glm::ivec3 v) {
                return glm::all(glm::greaterThanEqual(v, glm::ivec3(4))) && glm::all(glm::lessThan(v, glm::ivec3(20)));
            };
            if (!deep(at) || !deep(there)) continue;
            ASSERT_EQ(light[size_t(index(at))], now[size_t(index(there))]);
            compared += light[size_t(index(at))][0].x > 0 ? 1 : 0;
        }
        EXPECT_GT(compared, 100);
    }
    EXPECT_TRUE(moved);
    EXPECT_TRUE(stood);
}

/// Nested cascades: each twice as wide as the one before, in whole cells, and ahead of the camera.
TEST(LpvGridTest, CascadesAreNestedAndMoveByWholeCells) {
    const Bounds scene{glm::vec3(-4, 0, -4), glm::vec3(4, 3, 4)};
    LpvPlacement placement;
    placement.cells = 16, placement.cascades = 3;
    const LpvGrid standing = lpv_grid(placement, scene, glm::vec3(1, 1, 1), glm::vec3(0, 0, -1));
    EXPECT_EQ(standing.cascade[2].base, glm::ivec3(0));
    EXPECT_FLOAT_EQ(standing.cascade[0].cell * 4, standing.cascade[2].cell);
    for (int step = 0; step < 50; ++step) {
        const glm::vec3 position(0.037f * float(step), 1.3f, -0.05f * float(step));
        const LpvGrid grid = lpv_grid(placement, scene, position, glm::vec3(0, 0, -1));
        for (int k = 0; k < 2; ++k) {
            const LpvCascade& cascade = grid.cascade[k];
            EXPECT_EQ(cascade.anchor, standing.cascade[2].anchor);
            const glm::vec3 middle = cascade.anchor + cascade.cell * (glm::vec3(cascade.base) + 8.0f);
            const glm::vec3 wanted = position + glm::vec3(0, 0, -1) * (placement.ahead * 8 * cascade.cell);
            EXPECT_LE(glm::length(middle - wanted), 0.5f * std::sqrt(3.0f) * cascade.cell * 1.001f);
        }
        EXPECT_EQ(grid.cascade[2].base, glm::ivec3(0)) << "the outermost holds the scene";
    }
}
