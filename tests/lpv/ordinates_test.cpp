// Ordinates: links against the scene's triangles, the sweep against sums on the CPU, what it keeps and what walls stop.
#include "lpv/lpv_fixture.h"

#include <cmath>

using namespace bounce;

namespace {

class LpvOrdinates : public LpvTest {
  protected:
    static constexpr int k_directions = 24;
    /// `write` is GLSL: the radiance of the cell `at` of cascade `c` along direction m as the value of `float l`.
    void make_swept(const std::string& write, const LpvSets& sets, Scene scene = blocks()) {
        shader("test/beams.comp", R"(#include "lpv/grid.glsl"
#include "lpv/ordinates.glsl"
layout(local_size_x = 64) in;
layout(std430) writeonly buffer lpv_ordinates { uvec2 ordinates[]; };
void main() {
    int cell = int(gl_GlobalInvocationID.x), m = int(gl_GlobalInvocationID.y), count = grid_cascades * cells_of_cascade();
    if (cell >= count || m >= directions) return;
    ivec3 at = cell_of_index(uint(cell % cells_of_cascade()), grid_size());
    int c = cell / cells_of_cascade();
    float l = 0.0;
    )" + write + R"(
    ordinates[m * count + cell] = packed_light(vec3(l));
}
)");
        shader("test/read.comp", R"(#include "lpv/grid.glsl"
#include "lpv/ordinates.glsl"
layout(local_size_x = 64) in;
layout(std430) readonly buffer lpv_ordinates { uvec2 ordinates[]; };
layout(std430) writeonly buffer test_light { vec4 light[]; };
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i < light.length()) light[i] = vec4(unpacked_light(ordinates[i]), 0.0);
}
)");
        Changes changes;
        changes.resources = R"("test.light":{"kind":"buffer","count":"lpv.ordinates.count","stride":16},)";
        changes.removed = R"("inject_ordinates")";
        changes.passes = R"({"before":"sweep","id":"inject_ordinates","type":"compute","shader":"test/beams.comp",
              "params":{"directions":"=directions"},"dispatch":["cascades * cells ^ 3","directions"]},
            {"after":"sweep","id":"read","type":"compute","shader":"test/read.comp","dispatch":["lpv.ordinates.count"]})";
        LpvSets all{{"graph.angular", "ordinates"}, {"graph.directions", std::to_string(k_directions)}};
        all.insert(all.end(), sets.begin(), sets.end());
        make(std::move(scene), {point_light({0.4f, 1.5f, 0.2f}, {3, 4, 5})}, all, changes);
    }
    /// Radiance of all cells along one direction, of one cascade.
    std::vector<double> along(int direction, int cascade = 0) const {
        const LpvGrid g = grid();
        const std::vector<glm::vec4> all = run->read_buffer<glm::vec4>("test.light");
        const size_t count = size_t(g.cells) * size_t(g.cells) * size_t(g.cells);
        std::vector<double> own(count);
        for (size_t i = 0; i < count; ++i)
            own[i] = all[(size_t(direction) * size_t(g.cascades) + size_t(cascade)) * count + i].x;
        return own;
    }
    /// As in glsl/lpv/ordinates.glsl.
    static glm::dvec3 ordinate(int m) {
        const double z = 1 - (2.0 * m + 1) / k_directions, turn = 2.39996322973 * m, ring = std::sqrt(1 - z * z);
        const glm::dmat3 tilt{{0.64863783, 0.68211449, -0.33762227},
                              {-0.57400305, 0.72972141, 0.37152007},
                              {0.49978942, -0.04718577, 0.86486070}};
        return tilt * glm::dvec3(ring * std::cos(turn), ring * std::sin(turn), z);
    }
    static int largest(glm::dvec3 d) {
        const glm::dvec3 a = glm::abs(d);
        return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    }
};

} // namespace

TEST_F(LpvOrdinates, LinksAreCutByTheTrianglesThatCrossThem) {
    make_swept("", {{"graph.cells", "12"}});
    const LpvCascade cascade = grid().cascade[0];
    const std::vector<uint32_t> links = run->read_buffer<uint32_t>("lpv.links");
    ASSERT_EQ(links.size(), 12u * 12 * 12);
    struct Link {
        glm::ivec3 from, step;
    };
    // As in glsl/lpv/link_bits.glsl.
    const Link table[13] = {{{0, 0, 0}, {1, 0, 0}},  {{0, 0, 0}, {0, 1, 0}},  {{0, 0, 0}, {0, 0, 1}},
                            {{0, 0, 0}, {0, 1, 1}},  {{0, 0, 1}, {0, 1, -1}}, {{0, 0, 0}, {1, 0, 1}},
                            {{1, 0, 0}, {-1, 0, 1}}, {{0, 0, 0}, {1, 1, 0}},  {{0, 1, 0}, {1, -1, 0}},
                            {{0, 0, 0}, {1, 1, 1}},  {{0, 1, 0}, {1, -1, 1}}, {{0, 0, 1}, {1, 1, -1}},
                            {{0, 1, 1}, {1, -1, -1}}};
    int cut = 0, open = 0;
    for (int i = 0; i < 12 * 12 * 12; ++i) {
        const glm::ivec3 at(i % 12, i / 12 % 12, i / 144);
        if (glm::any(glm::equal(at, glm::ivec3(11)))) continue;
        for (int bit = 0; bit < 13; ++bit) {
            int expected = 0;
            for (size_t t = 0; t + 2 < run->scene.indices.size() && expected != 1; t += 3) {
                glm::dvec3 p[3];
                for (size_t k = 0; k < 3; ++k)
                    p[k] = (glm::dvec3(run->scene.vertices[run->scene.indices[t + k]].position) -
                            glm::dvec3(cascade.anchor)) /
                               double(cascade.cell) -
                           0.5;
                const int one = crosses(p, glm::dvec3(at + table[bit].from), glm::dvec3(table[bit].step));
                if (one != 0) expected = one;
            }
            if (expected < 0) continue;
            EXPECT_EQ(int(links[size_t(i)] >> bit & 1u), expected) << i << ", link " << bit;
            (expected ? cut : open) += 1;
        }
    }
    EXPECT_GT(cut, 300);
    EXPECT_GT(open, 3000);
}

/// Without surfaces, planes across a direction's largest component all carry what the lone cell sends, until it leaves
/// by a side.
TEST_F(LpvOrdinates, TheSweepKeepsABeamsLight) {
    // The scene lies aside of the beams.
    make_swept("if (at == ivec3(8)) l = 1.0;", {{"graph.cells", "17"}},
               MadeScene()
                   .quad({0, 0, 0}, {0, 0, 9}, {0, 9, 9}, {0, 9, 0})
                   .quad({9, 0, 0}, {9, 0, 9}, {9, 0.01f, 9}, {9, 0.01f, 0})
                   .scene);
    for (int m = 0; m < k_directions; ++m) {
        const glm::dvec3 direction = ordinate(m);
        const int axis = largest(direction), sign = direction[axis] > 0 ? 1 : -1;
        const std::vector<double> light = along(m);
        std::vector<double> expected(light.size(), 0);
        expected[size_t(index(glm::ivec3(8)))] = 1;
        for (int k = 1; k <= 6; ++k) {
            double sum = 0;
            const int plane = 8 + sign * k;
            for (int i = 0; i < 17 * 17 * 17; ++i) {
                const glm::ivec3 at(i % 17, i / 17 % 17, i / 289);
                if (at[axis] != plane) continue;
                sum += light[size_t(i)];
                // Four cells around where the ray comes from.
                const glm::dvec3 from = glm::dvec3(at) - direction / std::abs(direction[axis]);
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                for (int c = 0; c < 4; ++c) {
                    glm::ivec3 before;
                    before[axis] = plane - sign;
                    before[u] = int(std::floor(from[u])) + (c & 1), before[v] = int(std::floor(from[v])) + (c >> 1);
                    if (glm::any(glm::lessThan(before, glm::ivec3(0))) ||
                        glm::any(glm::greaterThan(before, glm::ivec3(16))))
                        continue;
                    const double weight = (1 - std::abs(from[u] - before[u])) * (1 - std::abs(from[v] - before[v]));
                    expected[size_t(i)] += weight * expected[size_t(index(before))];
                }
                ASSERT_NEAR(light[size_t(i)], expected[size_t(i)], 2e-3) << m << ": " << i;
            }
            EXPECT_NEAR(sum, 1, 4e-3) << "direction " << m << ", plane " << k;
        }
        double behind = 0;
        for (int i = 0; i < 17 * 17 * 17; ++i) {
            const glm::ivec3 at(i % 17, i / 17 % 17, i / 289);
            if (sign * (at[axis] - 8) < 0) behind += light[size_t(i)];
        }
        EXPECT_EQ(behind, 0);
    }
}

TEST_F(LpvOrdinates, NothingLeavesAClosedBox) {
    MadeScene made;
    made.box({-1, -1, -1}, {1, 1, 1}).box({-0.35f, -0.3f, -0.4f}, {0.3f, 0.35f, 0.45f});
    make_swept("if (at == ivec3(7)) l = 1.0;", {{"graph.cells", "15"}}, made.scene);
    const LpvCascade cascade = grid().cascade[0];
    for (int m = 0; m < k_directions; ++m) {
        const std::vector<double> light = along(m);
        for (int i = 0; i < 15 * 15 * 15; ++i) {
            const glm::vec3 middle = cascade.anchor + cascade.cell * (glm::vec3(i % 15, i / 15 % 15, i / 225) + 0.5f);
            const bool inside = middle.x > -0.35f && middle.x < 0.3f && middle.y > -0.3f && middle.y < 0.35f &&
                                middle.z > -0.4f && middle.z < 0.45f;
            if (!inside) {
                EXPECT_EQ(light[size_t(i)], 0) << i;
            }
        }
    }
}

/// A field that is the same everywhere, in three cascades, is what each surface gathers: no seam, no darkening beside
/// walls.
TEST_F(LpvOrdinates, AnEvenFieldGathersItself) {
    for (const char* in_front : {"false", "true"}) {
        make_swept("l = 0.75;",
                   {{"graph.cells", "12"}, {"graph.cascades", "3"}, {"gather_ordinates.in_front", in_front}});
        // The sweep would add to it.
        shader("lpv/sweep.comp",
               "#include \"lpv/links.glsl\"\n#include \"lpv/ordinates.glsl\"\nlayout(local_size_x = 8, local_size_y = "
               "8) in;\n"
               "layout(std430) buffer lpv_ordinates { uvec2 ordinates[]; }; //! ordered: nothing is written\n"
               "void main() { if (directions > 999) ordinates[0] = ordinates[1]; }\n");
        make_swept("l = 0.75;",
                   {{"graph.cells", "12"}, {"graph.cascades", "3"}, {"gather_ordinates.in_front", in_front}});
        const std::vector<float> light = run->read("lpv.irradiance"), depth = run->read("gbuffer.depth");
        int seen = 0;
        for (size_t i = 0; i < light.size() / 4; ++i)
            if (light[4 * i] > 0) {
                EXPECT_NEAR(light[4 * i], 0.75, 1e-3);
                ++seen;
            }
        EXPECT_GT(seen, 100);
    }
}

/// What enters a finer cascade is what the outer one has there.
TEST_F(LpvOrdinates, LightOfOuterCascadesEntersInnerOnes) {
    make_swept("if (c == 1 && m == 3) l = 1.0; else l = 0.0;", {{"graph.cells", "12"}, {"graph.cascades", "2"}},
               MadeScene()
                   .quad({-5, -5, -5}, {-5, -5, -4}, {-5, -4.9f, -4}, {-5, -4.9f, -5})
                   .quad({5, 5, 5}, {5, 5, 4}, {5, 4.9f, 4}, {5, 4.9f, 5})
                   .scene);
    double inner = 0, outer = 0;
    for (double value : along(3, 0))
        inner = std::max(inner, value);
    for (double value : along(3, 1))
        outer = std::max(outer, value);
    EXPECT_GT(inner, 1);
    EXPECT_LE(inner, outer * 1.001);
    for (double value : along(4, 0))
        EXPECT_EQ(value, 0);
}
