// The trace in layered depth maps between parallel plates, where every distance is known: h/|d·n| both ways.
#include "ldm/lists_fixture.h"

using namespace bounce;

namespace {

constexpr float k_no_hit = 1e30f;
constexpr int k_maps = 24, k_points = 8;

Scene plates(const std::vector<float>& heights) {
    MadeScene made;
    for (float h : heights)
        made.quad({-10, h, 10}, {10, h, 10}, {10, h, -10}, {-10, h, -10});
    return made.scene;
}

struct Traced {
    int map;
    LdmView view;
    glm::vec3 x;
    float against, along; ///< metres
    double up() const { return view.direction.y > 0 ? along : against; }
    double down() const { return view.direction.y > 0 ? against : along; }
    double steepness() const { return std::abs(view.direction.y); }
    double texel() const { return std::max(view.texel.x, view.texel.y); }
};

class LdmTrace : public LdmTest {
  protected:
    /// All maps that do not see the plates too flat, at points of height `y`; `middle`: points that lie in the middle
    /// of a texel, where depths are exact.
    std::vector<Traced> trace(const std::vector<float>& heights, float y, bool middle, Sets sets) {
        shader("test/trace.comp", R"(
            #include "ldm/trace.glsl"
            layout(local_size_x = 8, local_size_y = 8) in;
            layout(FORMAT_test_hits) writeonly uniform image2D test_hits;
            layout(FORMAT_test_points) writeonly uniform image2D test_points;
            uniform float height = 0.0; //! [-100, 100] of the points
            uniform bool middle = false; //! points are moved to the middle of their texel
            void main() {
                ivec2 at = ivec2(gl_GlobalInvocationID.xy);
                if (any(greaterThanEqual(at, imageSize(test_hits)))) return;
                LdmView view = views[at.x];
                vec3 x = vec3(0.0371 * float(at.y) - 0.11, height, 0.13 - 0.0293 * float(at.y));
                vec2 p = ldm_project(view, x).xy;
                if (middle) {
                    mat2 m = mat2(view.to_x.x, view.to_y.x, view.to_x.z, view.to_y.z);
                    vec2 d = inverse(m) * (floor(p) + 0.5 - p);
                    x += vec3(d.x, 0.0, d.y);
                }
                LdmHits hits = ldm_trace(at.x, view, x, vec3(0.0, 1.0, 0.0));
                imageStore(test_hits, at, vec4(hits.distance, 0.0, 0.0));
                imageStore(test_points, at, vec4(x, 0.0));
            })");
        sets.insert(sets.end(), {{"ldm.maps", std::to_string(k_maps)},
                                 {"ldm.tilted", "true"},
                                 {"trace.height", fmt::format("{}", y)},
                                 {"trace.middle", middle ? "true" : "false"}});
        if (std::none_of(sets.begin(), sets.end(), [](auto& set) { return set.first == "ldm.resolution"; }))
            sets.emplace_back("ldm.resolution", "64");
        SceneRunner run(plates(heights), {},
                        graph_file(fmt::format(R"("resources":{{
            "test.hits":{{"format":"rgba32f","size":[{0},{1}]}},"test.points":{{"format":"rgba32f","size":[{0},{1}]}}}},
            "passes":[{{"type":"ldm"}},{{"id":"trace","type":"compute","shader":"test/trace.comp"}}])",
                                               k_maps, k_points)),
                        sets);
        whole_frame(run);
        std::vector<LdmView> views = run.read_buffer<LdmView>("ldm.views");
        std::vector<float> hits = run.read("test.hits"), points = run.read("test.points");
        std::vector<Traced> all;
        for (int map = 0; map < k_maps; ++map) {
            for (int i = 0; i < k_points; ++i) {
                size_t at = 4 * size_t(i * k_maps + map);
                Traced t{map, views[size_t(map)], {points[at], points[at + 1], points[at + 2]}, hits[at], hits[at + 1]};
                if (t.steepness() > 0.25) all.push_back(t);
            }
        }
        EXPECT_GT(all.size(), size_t(k_maps * k_points / 2));
        return all;
    }
    static void expect_distance(double got, double wanted, const Traced& t, const char* what, double allowed = 5e-4) {
        if (wanted >= k_no_hit)
            EXPECT_EQ(got, k_no_hit) << what << ", map " << t.map;
        else
            EXPECT_NEAR(got, wanted, allowed) << what << ", map " << t.map;
    }
};

} // namespace

TEST_F(LdmTrace, BothNeighboursInOneWalk) {
    for (const char* own : {"tolerance", "nearest"}) {
        for (const Traced& t :
             trace({-0.5f, 0, 1}, 0, true, {{"trace.own_surface", own}, {"trace.tolerance", "0.01"}})) {
            expect_distance(t.up(), 1 / t.steepness(), t, own);
            expect_distance(t.down(), 0.5 / t.steepness(), t, own);
        }
        for (const Traced& t :
             trace({-0.5f, 0, 1}, 1, true, {{"trace.own_surface", own}, {"trace.tolerance", "0.01"}})) {
            expect_distance(t.up(), k_no_hit, t, own);
            expect_distance(t.down(), 1 / t.steepness(), t, own);
        }
        for (const Traced& t :
             trace({-0.5f, 0, 1}, -0.5f, true, {{"trace.own_surface", own}, {"trace.tolerance", "0.01"}})) {
            expect_distance(t.up(), 0.5 / t.steepness(), t, own);
            expect_distance(t.down(), k_no_hit, t, own);
        }
    }
}

/// Nodes nearer than the tolerance are x's own surface, also where they are not.
TEST_F(LdmTrace, ToleranceIsInTexels) {
    const std::vector<float> heights{0, 0.05f, 0.2f, 1, 4};
    for (float tolerance : {0.01f, 0.25f, 1.0f, 4.0f}) {
        int passed_by = 0;
        for (const Traced& t :
             trace(heights, 0, true, {{"trace.tolerance", fmt::format("{}", tolerance)}, {"ldm.resolution", "100"}})) {
            double apart = tolerance * t.texel(), wanted = k_no_hit;
            bool doubtful = false;
            for (size_t i = heights.size() - 1; i > 0; --i) {
                double distance = heights[i] / t.steepness();
                doubtful = doubtful || std::abs(distance - apart) < 1e-3;
                if (distance > apart) wanted = distance;
            }
            if (doubtful) continue;
            expect_distance(t.up(), wanted, t, "up");
            passed_by += wanted > 0.06 / t.steepness();
            expect_distance(t.down(), k_no_hit, t, "down");
        }
        EXPECT_EQ(passed_by > 0, tolerance >= 0.25f) << tolerance;
    }
}

/// A point that is off its surface finds it by nearness, and not by a small tolerance.
TEST_F(LdmTrace, TheNearestNodeIsItsOwnSurfaceHoweverFar) {
    for (const Traced& t : trace({-0.5f, 0, 1}, 0.02f, true, {{"trace.tolerance", "0.01"}})) {
        expect_distance(t.down(), 0.02 / t.steepness(), t, "by tolerance");
        expect_distance(t.up(), 0.98 / t.steepness(), t, "by tolerance");
    }
    for (const Traced& t : trace({-0.5f, 0, 1}, 0.02f, true, {{"trace.own_surface", "nearest"}})) {
        expect_distance(t.down(), 0.52 / t.steepness(), t, "nearest");
        expect_distance(t.up(), 0.98 / t.steepness(), t, "nearest");
    }
    // Nearer to the plate above: that one is its own.
    for (const Traced& t : trace({-0.5f, 0, 1}, 0.7f, true, {{"trace.own_surface", "nearest"}})) {
        expect_distance(t.down(), 0.7 / t.steepness(), t, "above");
        expect_distance(t.up(), k_no_hit, t, "above");
    }
}

/// Off the texel's middle a depth is wrong by its slope; nodes that hold their plane are not.
TEST_F(LdmTrace, PlanesAreExactAwayFromTheTexelsMiddle) {
    const Sets far_off{{"trace.tolerance", "0.01"}, {"ldm.nodes", "plane"}};
    double worst = 0;
    for (const Traced& t : trace({-1.5f, 0, 2}, 0, false, {{"trace.own_surface", "nearest"}, {"ldm.nodes", "depth"}})) {
        // dz/dx and dz/dy of a horizontal plate, metres of depth a texel: by moving along the plate.
        glm::dvec3 right(t.view.to_x), up(t.view.to_y), n(0, 1, 0), d(t.view.direction);
        right *= double(t.view.texel.x), up *= double(t.view.texel.y); // unit vectors
        double slope = std::abs(glm::dot(right, n) / glm::dot(d, n)) * t.view.texel.x +
                       std::abs(glm::dot(up, n) / glm::dot(d, n)) * t.view.texel.y;
        expect_distance(t.up(), 2 / t.steepness(), t, "depths", 0.5 * slope + 1e-3);
        worst = std::max(worst, std::abs(t.up() - 2 / t.steepness()));
    }
    EXPECT_GT(worst, 0.05) << "else there is nothing to cure";
    Sets planes = far_off;
    planes.emplace_back("trace.node_planes", "true");
    for (const Traced& t : trace({-1.5f, 0, 2}, 0, false, planes)) {
        expect_distance(t.up(), 2 / t.steepness(), t, "planes", 4e-3); // slopes are half floats
        expect_distance(t.down(), 1.5 / t.steepness(), t, "planes", 4e-3);
    }
}

TEST_F(LdmTrace, TheNormalOffsetMovesThePointOffItsSurface) {
    for (float offset : {0.0f, 0.71f, 1.5f}) {
        for (const Traced& t : trace({-1.5f, 0, 2}, 0, false,
                                     {{"trace.own_surface", "nearest"},
                                      {"trace.node_planes", "true"},
                                      {"ldm.nodes", "surface"},
                                      {"trace.normal_offset", fmt::format("{}", offset)}})) {
            double lifted = offset * t.texel() * std::sqrt(1 - t.steepness() * t.steepness());
            expect_distance(t.up(), (2 - lifted) / t.steepness(), t, "up", 8e-3);
            expect_distance(t.down(), (1.5 + lifted) / t.steepness(), t, "down", 8e-3);
        }
    }
}
