// The propagation in harmonics: its solid angles, its losses, its symmetry, and all of it against sums on the CPU.
#include "lpv/lpv_fixture.h"

#include <cmath>

using namespace bounce;

namespace {

/// One colour of one cell: c_00, c_1x, c_1y, c_1z.
using Coefficients = glm::dvec4;

double intensity(const Coefficients& c, glm::dvec3 d) {
    return c.x * std::sqrt(1 / (4 * M_PI)) + std::sqrt(3 / (4 * M_PI)) * glm::dot(glm::dvec3(c.y, c.z, c.w), d);
}

/// One iteration, as the paper has it: each cell sends through the five faces of each of its neighbours.
struct Propagation {
    int side;
    bool normalise = false;
    std::function<double(glm::ivec3 from, glm::ivec3 to, glm::dvec3 direction)> open;

    std::vector<Coefficients> step(const std::vector<Coefficients>& light) const {
        std::vector<Coefficients> next(light.size(), Coefficients(0));
        auto index = [&](glm::ivec3 at) { return size_t((at.z * side + at.y) * side + at.x); };
        const double far = 0.4006696846, aside = 0.4234413544;
        for (int z = 0; z < side; ++z)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const glm::ivec3 at(x, y, z);
                    const Coefficients own = light[index(at)];
                    if (own == Coefficients(0)) continue;
                    struct Ray {
                        glm::ivec3 to;
                        glm::dvec3 face;
                        double flux;
                    };
                    std::vector<Ray> rays;
                    double sent = 0;
                    for (int k = 0; k < 6; ++k) {
                        glm::ivec3 ahead(0);
                        ahead[k / 2] = k % 2 ? -1 : 1;
                        for (int j = -1; j < 4; ++j) {
                            glm::dvec3 face(ahead);
                            if (j >= 0) face = glm::dvec3(0), face[(k / 2 + 1 + j / 2) % 3] = j % 2 ? -1 : 1;
                            glm::dvec3 direction =
                                j < 0 ? face : glm::normalize(glm::dvec3(ahead) + 0.5 * face); // to the face's middle
                            double flux = (j < 0 ? far : aside) * std::max(intensity(own, direction), 0.0);
                            sent += flux;
                            if (open) flux *= open(at, at + ahead, direction);
                            rays.push_back({at + ahead, face, flux});
                        }
                    }
                    const double scale = normalise && sent > 0 ? own.x * 2 * std::sqrt(M_PI) / sent : 1;
                    for (const Ray& ray : rays) {
                        if (glm::any(glm::lessThan(ray.to, glm::ivec3(0))) ||
                            glm::any(glm::greaterThanEqual(ray.to, glm::ivec3(side))))
                            continue;
                        next[index(ray.to)] +=
                            scale * ray.flux / M_PI * Coefficients(std::sqrt(M_PI) / 2, std::sqrt(M_PI / 3) * ray.face);
                    }
                }
        return next;
    }
};

class LpvPropagate : public LpvTest {
  protected:
    static std::vector<Coefficients> of_colour(const std::vector<LpvLight>& light, int colour) {
        std::vector<Coefficients> all;
        for (const LpvLight& cell : light)
            all.emplace_back(cell[colour]);
        return all;
    }
    void expect_light(const std::vector<LpvLight>& got, const std::vector<Coefficients>& expected, double tolerance) {
        double most = 0;
        for (const Coefficients& c : expected)
            most = std::max(most, std::abs(c.x));
        ASSERT_GT(most, 0);
        ASSERT_EQ(got.size(), expected.size());
        for (size_t i = 0; i < got.size(); ++i)
            for (int k = 0; k < 4; ++k)
                ASSERT_NEAR(got[i][0][k], expected[i][k], tolerance * most) << "cell " << i << ", coefficient " << k;
    }
    static constexpr const char* k_lone = "if (at == ivec3(7)) c = vec4(1.0, 0.0, 0.0, 0.0);";
    static constexpr const char* k_lobe =
        "if (at == ivec3(7)) c = lobe_about(normalize(vec3(1.0, 2.0, -0.5)), vec3(1.0))[0];";
    static LpvSets empty(int iterations) {
        return {
            {"graph.cells", "15"}, {"graph.iterations", std::to_string(iterations)}, {"propagate.blocking", "none"}};
    }
};

} // namespace

/// What a lone even cell sends its neighbours tells the solid angles of their faces.
TEST_F(LpvPropagate, SolidAnglesOfFacesSumToTheSphere) {
    make_with_light(k_lone, empty(1));
    const std::vector<LpvLight> light = wave(1);
    const double sent = std::sqrt(1 / (4 * M_PI));                           // intensity any way
    const double far = 4 * std::asin(0.1), aside = (4 * M_PI / 6 - far) / 4; // a square of side 1 at a distance of 1.5
    double all = 0;
    for (int k = 0; k < 6; ++k) {
        glm::ivec3 at(7);
        at[k / 2] += k % 2 ? -1 : 1;
        const glm::vec4 c = light[size_t(index(at))][0];
        const double far_face = std::abs(double(c[k / 2 + 1])) * M_PI / std::sqrt(M_PI / 3) / sent;
        const double faces = double(c.x) * 2 * std::sqrt(M_PI) / sent; // flux over intensity
        EXPECT_NEAR(far_face, far, 1e-5);
        EXPECT_NEAR((faces - far_face) / 4, aside, 2e-5);
        all += faces;
    }
    EXPECT_NEAR(all, 4 * M_PI, 1e-4 * 4 * M_PI);
}

TEST_F(LpvPropagate, FollowsTheSchemeOnTheCpu) {
    for (bool normalise : {false, true}) {
        LpvSets sets = empty(4);
        sets.push_back({"propagate.normalise", normalise ? "true" : "false"});
        make_with_light(k_lobe, sets);
        Propagation scheme{15, normalise, {}};
        std::vector<Coefficients> expected(15 * 15 * 15, Coefficients(0)), sum;
        const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, -0.5));
        expected[size_t(index(glm::ivec3(7)))] = {std::sqrt(M_PI) / 2, std::sqrt(M_PI / 3) * n};
        sum = expected;
        for (int i = 0; i < 4; ++i) {
            expected = scheme.step(expected);
            for (size_t k = 0; k < sum.size(); ++k)
                sum[k] += expected[k];
        }
        expect_light(wave(4), expected, 1e-5);
        expect_light(run->read_buffer<LpvLight>("lpv.sum"), sum, 1e-5);
    }
}

/// In an empty grid the scheme loses nothing: its solid angles are 2·10⁻⁵ too large. What it does is to cut off
/// negative intensities, which adds light; with `normalise` it does not.
TEST_F(LpvPropagate, LosesNothingInAnEmptyGrid) {
    make_with_light(k_lone, empty(1));
    const double excess = 6 * (0.4006696846 + 4 * 0.4234413544) / (4 * M_PI) - 1;
    EXPECT_NEAR(flux(wave(1)) / flux({{{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}}) - 1, excess, 1e-6);
    EXPECT_LT(std::abs(excess), 3e-5);
    make_with_light(k_lobe, empty(1));
    const double clipped = flux(wave(1)) - 1; // a lobe's flux over π is 1
    EXPECT_GT(clipped, 0.05);
    EXPECT_LT(clipped, 0.2);
    RecordProperty("added_by_the_first_iteration", fmt::format("{:.4f}", clipped));
    for (int iterations : {1, 3, 6}) { // the light reaches no side
        LpvSets sets = empty(iterations);
        sets.push_back({"propagate.normalise", "true"});
        make_with_light(k_lobe, sets);
        EXPECT_NEAR(flux(wave(iterations)), 1, 1e-5) << iterations;
    }
}

TEST_F(LpvPropagate, ALoneCellsLightSpreadsSymmetrically) {
    make_with_light(k_lone, empty(6));
    const std::vector<LpvLight> light = wave(6);
    double most = 0;
    for (const LpvLight& cell : light)
        most = std::max(most, double(cell[0].x));
    int lit = 0;
    for (int i = 0; i < 15 * 15 * 15; ++i) {
        const glm::ivec3 at(i % 15, i / 15 % 15, i / 225);
        const glm::vec4 own = light[size_t(index(at))][0];
        lit += own.x > 0 ? 1 : 0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 mirrored = at;
            mirrored[axis] = 14 - at[axis];
            glm::vec4 other = light[size_t(index(mirrored))][0];
            other[axis + 1] = -other[axis + 1];
            // Compilers add up in an order of their own, so not to the bit.
            for (int k = 0; k < 4; ++k)
                ASSERT_NEAR(own[k], other[k], 1e-7 * most) << "cell " << i << ", mirrored along " << axis;
        }
        const glm::vec4 turned = light[size_t(index({at.y, at.z, at.x}))][0];
        ASSERT_NEAR(own.x, turned.x, 1e-7 * most);
        ASSERT_NEAR(own.y, turned.w, 1e-7 * most);
    }
    EXPECT_GT(lit, 200);
}

/// A plane of blockers as dense as a wall: the lobe of l ≤ 1 stops ¾ of what meets it head-on and nothing from behind.
TEST_F(LpvPropagate, AWallOfBlockersStopsWhatTheSchemeSays) {
    shader("test/wall.comp", R"(#include "lpv/grid.glsl"
layout(local_size_x = 64) in;
layout(std430) writeonly buffer lpv_blocking { vec4 blockers[]; };
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i < blockers.length()) blockers[i] = i % (grid_cells + 1) == 9 ? vec4(-1.0, 0.0, 0.0, 1.0) : vec4(0.0);
}
)");
    shader("test/light.comp", R"(#include "lpv/grid.glsl"
#include "lpv/light.glsl"
layout(local_size_x = 64) in;
layout(std430) writeonly buffer lpv_light { mat3x4 light[]; };
layout(std430) writeonly buffer lpv_sum { mat3x4 sums[]; };
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= sums.length()) return;
    vec4 c = cell_of_index(uint(i), grid_size()) == ivec3(7) ? vec4(1.0, 0.0, 0.0, 0.0) : vec4(0.0);
    light[i] = sums[i] = mat3x4(c, c, c);
}
)");
    Changes changes;
    changes.removed = R"("blend","inject","blocking")";
    changes.passes = R"({"after":"surfels","id":"blocking","type":"compute","shader":"test/wall.comp","needs":"lights",
            "dispatch":["lpv.blocking.count"]},
        {"id":"inject","type":"compute","shader":"test/light.comp","needs":"lights","dispatch":["lpv.sum.count"]})";
    make(blocks(), {point_light({0.4f, 1.5f, 0.2f}, {3, 4, 5})}, {{"graph.cells", "15"}, {"graph.iterations", "5"}},
         changes);
    int iteration = 0;
    Propagation scheme{15, false, [&](glm::ivec3 from, glm::ivec3 to, glm::dvec3 direction) {
                           // The volume's cells lie about corners: beside the wall two of a crossing's four are on it.
                           const bool through = std::min(from.x, to.x) == 8 && std::max(from.x, to.x) == 9;
                           const bool beside = from.x == to.x && (from.x == 8 || from.x == 9);
                           if (iteration == 0 || !(through || beside)) return 1.0;
                           return 1 - std::clamp((through ? 1 : 0.5) * (0.25 + 0.5 * direction.x), 0.0, 1.0);
                       }};
    std::vector<Coefficients> expected(15 * 15 * 15, Coefficients(0)), free = expected;
    expected[size_t(index(glm::ivec3(7)))] = free[size_t(index(glm::ivec3(7)))] = {1, 0, 0, 0};
    const Propagation unhindered{15, false, {}};
    for (; iteration < 5; ++iteration)
        expected = scheme.step(expected), free = unhindered.step(free);
    expect_light(wave(5), expected, 1e-5);
    auto behind = [&](const std::vector<Coefficients>& light) {
        double sum = 0;
        for (int i = 0; i < 15 * 15 * 15; ++i)
            if (i % 15 > 8) sum += light[size_t(i)].x;
        return sum;
    };
    EXPECT_LT(behind(expected), 0.6 * behind(free));
    EXPECT_GT(behind(expected), 0.1 * behind(free)) << "no wall stops all of it";
}

/// Links are exact: nothing leaves a box that is closed.
TEST_F(LpvPropagate, NothingPassesLinksOfAClosedBox) {
    MadeScene made;
    made.box({-1, -1, -1}, {1, 1, 1}, glm::vec3(0.5f))
        .box({-0.35f, -0.3f, -0.4f}, {0.3f, 0.35f, 0.45f}, glm::vec3(0.5f));
    make_with_light(k_lone, {{"graph.cells", "15"}, {"graph.iterations", "12"}, {"propagate.blocking", "links"}},
                    made.scene);
    const std::vector<LpvLight> sum = run->read_buffer<LpvLight>("lpv.sum");
    const LpvCascade cascade = grid().cascade[0];
    int inside = 0;
    for (int i = 0; i < 15 * 15 * 15; ++i) {
        const glm::vec3 middle = cascade.anchor + cascade.cell * (glm::vec3(i % 15, i / 15 % 15, i / 225) + 0.5f);
        const bool in_box = middle.x > -0.35f && middle.x < 0.3f && middle.y > -0.3f && middle.y < 0.35f &&
                            middle.z > -0.4f && middle.z < 0.45f;
        EXPECT_EQ(sum[size_t(i)][0].x > 0, in_box) << i;
        inside += in_box ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
}
