// Sets of cones over the hemisphere: weights, moments of the cosine-weighted hemisphere, interleaving, and their frame.
#include "support/scene_runner.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace bounce;

namespace {

struct Cone {
    glm::dvec3 direction;
    double weight;
};

class ConeSets : public SceneGraphTest {
  protected:
    /// Row y of the picture: the cones of set 0, 1 or 2 with `spiral` cones and the part of texel y of an interleave.
    std::vector<std::vector<Cone>> cones(int set, int spiral, int interleave) {
        shader("test/cones.comp", R"(#include "voxel/cone_set.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_test_cones) writeonly uniform image2D test_cones;
uniform int kind = 0;       //! [0, 2] set
uniform int spiral = 4;     //! [4, 128] cones of a spiral
uniform int interleave = 1; //! [1, 8] n
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(test_cones)))) return;
    float part = interleaved_part(ivec2(at.y % interleave, at.y / interleave), interleave);
    imageStore(test_cones, at, at.x < cone_count(kind, spiral) ? cone_of(kind, spiral, at.x, part) : vec4(-9.0, 0.0, 0.0, part));
}
)");
        SceneRunner run(MadeScene().triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1}).scene, {},
                        graph_file(fmt::format(
                            R"("resources":{{"test.cones":{{"format":"rgba32f","size":[129,{}]}}}},
                               "passes":[{{"id":"cones","type":"compute","shader":"test/cones.comp",
                                           "params":{{"kind":{},"spiral":{},"interleave":{}}}}}])",
                            interleave * interleave, set, spiral, interleave)));
        run.frame();
        std::vector<float> got = run.read("test.cones");
        std::vector<std::vector<Cone>> rows;
        parts.clear();
        for (int y = 0; y < interleave * interleave; ++y) {
            std::vector<Cone>& row = rows.emplace_back();
            for (int x = 0; x < 129; ++x) {
                const float* c = &got[4 * (size_t(y) * 129 + size_t(x))];
                if (c[0] != -9) row.push_back({{c[0], c[1], c[2]}, c[3]});
                if (x == 128) parts.push_back(c[3]);
            }
        }
        return rows;
    }
    std::vector<float> parts; ///< one a row
};

struct Moments {
    double weight = 0, square = 0; ///< Σ w, Σ w·cos²
    glm::dvec3 mean{0};            ///< Σ w·direction
};
Moments moments_of(const std::vector<Cone>& cones) {
    Moments m;
    for (const Cone& cone : cones) {
        EXPECT_NEAR(glm::length(cone.direction), 1, 1e-5);
        EXPECT_GT(cone.direction.z, 0);
        m.weight += cone.weight;
        m.square += cone.weight * cone.direction.z * cone.direction.z;
        m.mean += cone.weight * cone.direction;
    }
    return m;
}

} // namespace

/// The hemisphere weighted by the cosine has ⟨cos⟩ = 2/3 and ⟨cos²⟩ = 1/2.
TEST_F(ConeSets, WeightsSumToOneAndDirectionsToTheHemispheresMean) {
    double square_error[2] = {};
    for (int set : {0, 1}) {
        Moments m = moments_of(cones(set, 4, 1)[0]);
        EXPECT_NEAR(m.weight, 1, 1e-6);
        EXPECT_NEAR(m.mean.x, 0, 1e-6);
        EXPECT_NEAR(m.mean.y, 0, 1e-6);
        // Six cones cannot do both: 60° gives .625, 52.2° .709.
        EXPECT_NEAR(m.mean.z, set == 0 ? 0.625 : 0.25 + 0.75 * std::sqrt(0.375), 1e-5);
        square_error[set] = std::abs(m.square - 0.5);
        fmt::print("    {}: <cos> {:.4f}, <cos^2> {:.4f}\n", set == 0 ? "six" : "six_tilted", m.mean.z, m.square);
    }
    EXPECT_LT(square_error[1], 0.6 * square_error[0]) << "the tilted ring is the better quadrature";
    for (int n : {16, 32, 128}) {
        std::vector<Cone> spiral = cones(2, n, 1)[0];
        ASSERT_EQ(int(spiral.size()), n);
        Moments m = moments_of(spiral);
        EXPECT_NEAR(m.weight, 1, 1e-5);
        EXPECT_NEAR(m.mean.z, 2.0 / 3, 0.2 / n) << n; // midpoint rule of √x: the error falls like n^−1.5
        EXPECT_NEAR(m.square, 0.5, 1e-5) << n;        // … and is none for x
        EXPECT_LT(std::hypot(m.mean.x, m.mean.y), 1.0 / n) << n;
        // All around: the golden angle leaves no gap of more than 2.7 times the mean.
        std::vector<double> turns;
        for (const Cone& cone : spiral)
            turns.push_back(std::atan2(cone.direction.y, cone.direction.x));
        std::sort(turns.begin(), turns.end());
        turns.push_back(turns.front() + 2 * M_PI);
        for (size_t i = 0; i + 1 < turns.size(); ++i)
            EXPECT_LT(turns[i + 1] - turns[i], 2.7 * 2 * M_PI / n) << n;
    }
}

/// Neighbours in a block of n × n take different cones, each set once; together they are a finer set.
TEST_F(ConeSets, InterleavedPartsAreAPermutation) {
    for (int n = 1; n <= 8; ++n) {
        std::vector<std::vector<Cone>> rows = cones(2, 8, n);
        std::vector<float> sorted = parts;
        std::sort(sorted.begin(), sorted.end());
        for (int i = 0; i < n * n; ++i)
            EXPECT_NEAR(sorted[size_t(i)], (i + 0.5) / (n * n), 1e-6) << "n = " << n;
        Moments all;
        for (const std::vector<Cone>& row : rows) {
            Moments m = moments_of(row);
            EXPECT_NEAR(m.weight, 1, 1e-5);
            all.mean += m.mean / double(rows.size());
            all.square += m.square / double(rows.size());
        }
        EXPECT_NEAR(all.mean.z, 2.0 / 3, 0.2 / (8.0 * std::pow(n * n, 1.5)) + 1e-4) << "n = " << n;
        EXPECT_NEAR(all.square, 0.5, 1e-5) << "n = " << n;
    }
}

TEST_F(ConeSets, TheFrameAroundANormalIsOrthonormalAndRightHanded) {
    shader("test/frame.comp", R"(#include "voxel/cone_set.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_test_frame) writeonly uniform image2D test_frame;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    float z = 1.0 - float(at.y) * (2.0 / 16.0), turn = float(at.x / 3) * 0.7;
    vec3 n = vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
    if (at.y < 17) imageStore(test_frame, at, vec4(frame_around(n)[at.x % 3], dot(frame_around(n)[2], n)));
}
)");
    SceneRunner run(MadeScene().triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1}).scene, {},
                    graph_file(R"("resources":{"test.frame":{"format":"rgba32f","size":[24,17]}},
                                  "passes":[{"id":"frame","type":"compute","shader":"test/frame.comp"}])"));
    run.frame();
    std::vector<float> got = run.read("test.frame");
    for (size_t i = 0; i + 2 < got.size() / 4; i += 3) { // three columns, one after another
        glm::dvec3 t(got[4 * i], got[4 * i + 1], got[4 * i + 2]), b(got[4 * i + 4], got[4 * i + 5], got[4 * i + 6]),
            n(got[4 * i + 8], got[4 * i + 9], got[4 * i + 10]);
        EXPECT_NEAR(glm::length(glm::cross(t, b) - n), 0, 1e-5);
        EXPECT_NEAR(glm::length(t), 1, 1e-5);
        EXPECT_NEAR(glm::dot(t, b), 0, 1e-5);
        EXPECT_NEAR(got[4 * i + 3], 1, 1e-5) << "the third column is the normal";
    }
}
