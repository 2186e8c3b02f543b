// Rays through the cells against all discs, lists against what their rays meet, filtered lists against unions of sets.
#include "vf/vf_fixture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace bounce;

namespace {

constexpr int k_rays = 1500;

/// Counts of a cell in a list: seen, crossed.
using CellCounts = std::map<uint32_t, glm::uvec2>;

class VfMarch : public VfTest {
  protected:
    struct Ray {
        glm::dvec3 origin, direction;
        double t;
        int met; ///< entry; −1: none
    };
    /// Rays from all over the scene through a shader of the test's own.
    std::vector<Ray> march(const VfSets& sets) {
        shader("test/rays.comp", R"(#include "vf/march.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_rays) writeonly uniform image2D test_rays;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(test_rays).x) return;
    vec3 part = fract(vec3(0.8191725134, 0.6710436067, 0.5497004779) * float(i + 1));
    vec3 origin = grid.origin + part * grid.cell * vec3(grid.size);
    float z = fract(0.618033988 * float(i)) * 2.0 - 1.0, turn = 6.2831853 * fract(0.41421356 * float(i));
    vec3 direction = vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z);
    float t;
    int met = first_disc(origin, direction, 0.0, t);
    imageStore(test_rays, ivec2(i, 0), vec4(origin, t));
    imageStore(test_rays, ivec2(i, 1), vec4(direction, float(met)));
}
)");
        make(blocks(), light_above_blocks(), sets,
             fmt::format(R"("test.rays":{{"format":"rgba32f","size":[{},2]}},)", k_rays),
             fmt::format(R"({{"id":"rays","type":"compute","shader":"test/rays.comp","dispatch":[{}]}})", k_rays));
        for (int frame = 0; frame < 4 && grid().lost_copies > 0; ++frame)
            run->frame(); // until there are as many entries as are needed
        EXPECT_EQ(grid().lost_copies, 0u);
        std::vector<float> read = run->read("test.rays");
        std::vector<Ray> rays(k_rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            const float *from = &read[4 * i], *to = &read[4 * (i + k_rays)];
            rays[i] = {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}, from[3], int(to[3])};
        }
        return rays;
    }

    void read_lists() {
        lists_ = run->read_buffer<uint32_t>("vf.lists");
        filtered_ = run->read_buffer<uint32_t>("vf.filtered");
        std::vector<int32_t> sizes = run->read_buffer<int32_t>("vf.sizes");
        size_ = {sizes[0], sizes[1]};
        capacity_ = sizes[2], filtered_capacity_ = sizes[3];
    }
    CellCounts list(const std::vector<uint32_t>& all, int capacity, glm::ivec2 at) const {
        size_t start = size_t(at.y * size_.x + at.x) * size_t(4 + 2 * capacity);
        CellCounts cells;
        for (uint32_t k = 0; k < all[start]; ++k) {
            uint32_t cell = all[start + 4 + 2 * k], counts = all[start + 5 + 2 * k];
            EXPECT_FALSE(cells.contains(cell)) << "twice in a list";
            EXPECT_TRUE(cells.empty() || cells.rbegin()->first < cell) << "out of order";
            cells[cell] = {counts >> 16, counts & 0xffffu};
        }
        return cells;
    }
    std::vector<uint32_t> lists_, filtered_;
    glm::ivec2 size_{0};
    int capacity_ = 0, filtered_capacity_ = 0;
};

} // namespace

/// As published a disc is found in its centre's cell alone: some are missed, none is invented, and none is nearer.
TEST_F(VfMarch, AsPublishedMissesDiscsOfNeighbouringCells) {
    std::vector<Ray> rays = march({{"vf_proxies.disc_scale", "4"}});
    std::vector<VfProxy> own = proxies();
    int missed = 0, hits = 0;
    for (const Ray& ray : rays) {
        double nearest = 1e30;
        for (const VfProxy& proxy : own) {
            double t = meet_disc(proxy, ray.origin, ray.direction);
            if (t > 0) nearest = std::min(nearest, t);
        }
        if (nearest > 1e29) {
            EXPECT_LT(ray.met, 0);
            continue;
        }
        ++hits;
        if (ray.met < 0 || ray.t > nearest * 1.001 + 1e-4) ++missed;
        if (ray.met >= 0) {
            EXPECT_GT(ray.t, nearest * 0.999 - 1e-4);
        }
    }
    EXPECT_GT(missed, 0);
    EXPECT_LT(missed, hits / 3);
    RecordProperty("missed_of_hits", fmt::format("{} of {}", missed, hits));
}

/// With `overlap` the march finds what a search through all discs finds, however far they reach. It ends at the sides
/// of the box that holds the scene: no surface lies beyond, where only discs of its rim reach.
TEST_F(VfMarch, OverlapFindsWhatASearchThroughAllDiscsFinds) {
    for (const char* scale : {"1", "4", "16"}) {
        SCOPED_TRACE(scale);
        std::vector<Ray> rays = march({{"vf_proxies.disc_scale", scale}, {"vf_proxies.overlap", "true"}});
        std::vector<VfProxy> own = proxies();
        const VfGrid box = grid();
        int hits = 0, unsure = 0, copied = 0;
        for (const Ray& ray : rays) {
            double nearest = 1e30;
            const VfProxy* first = nullptr;
            bool close_call = false; // at a rim or a side of the box floats may decide otherwise
            for (const VfProxy& proxy : own) {
                VfProxy smaller = proxy, larger = proxy;
                smaller.radius *= 0.9999f, larger.radius *= 1.0001f;
                double t = meet_disc(larger, ray.origin, ray.direction);
                glm::dvec3 place = (ray.origin + t * ray.direction - glm::dvec3(box.origin)) / glm::dvec3(box.cell);
                glm::dvec3 inside = glm::min(place, glm::dvec3(box.size) - place);
                double depth = std::min({inside.x, inside.y, inside.z});
                if (t < 0 || depth < -1e-4 || t > nearest + 1e-4) continue;
                close_call = depth < 1e-4 || t < 1e-4 || meet_disc(smaller, ray.origin, ray.direction) < 0;
                nearest = t, first = &proxy;
            }
            if (close_call) {
                ++unsure;
                continue;
            }
            ASSERT_EQ(ray.met >= 0, first != nullptr);
            if (!first) continue;
            ++hits;
            EXPECT_NEAR(ray.t, nearest, 1e-4 + 1e-4 * nearest);
            glm::vec3 place(ray.origin + nearest * ray.direction);
            copied += index_of(box, cell_at(box, place)) != int(first->cell) ? 1 : 0;
        }
        EXPECT_GT(hits, 400);
        EXPECT_GT(copied, 0) << "no disc was met in a neighbour of its cell";
        EXPECT_LT(unsure, k_rays / 100);
        RecordProperty(scale, fmt::format("{} met, {} of them in neighbours of their cells", hits, copied));
    }
}

/// Rays slip between discs that just share the area, and hardly ever between those of four times the area.
TEST_F(VfMarch, RaysSlipBetweenSmallDiscs) {
    double slipped[2];
    int k = 0;
    for (const char* scale : {"1", "4"}) {
        shader("test/down.comp", R"(#include "vf/march.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_rays) writeonly uniform image2D test_rays;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(test_rays).x) return;
    vec2 part = fract(vec2(0.7548776662, 0.5698402910) * float(i + 1));
    float t;
    int met = first_disc(vec3(part * 1.6 - 0.8, 1.0).xzy, vec3(0.02, -1.0, 0.01), 0.0, t);
    imageStore(test_rays, ivec2(i, 0), vec4(met));
}
)");
        Scene floor = MadeScene().quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}).scene;
        make(floor, {directional_light({0, -1, 0}, {1, 1, 1})},
             {{"vf_proxies.disc_scale", scale}, {"vf_proxies.overlap", "true"}, {"vf_proxies.proxies", "2000"}},
             R"("test.rays":{"format":"rgba32f","size":[4000,1]},)",
             R"({"id":"rays","type":"compute","shader":"test/down.comp","dispatch":[4000]})");
        std::vector<float> read = run->read("test.rays");
        int through = 0;
        for (size_t i = 0; i < 4000; ++i)
            through += read[4 * i] < 0 ? 1 : 0;
        slipped[k++] = through / 4000.0;
    }
    EXPECT_GT(slipped[0], 0.1);
    EXPECT_LT(slipped[1], 0.01);
    RecordProperty("slipped", fmt::format("{:.4f} at the area, {:.4f} at four times", slipped[0], slipped[1]));
}

/// A filtered list is the union of the lists around it whose surfaces agree; counts add up.
TEST_F(VfMarch, TheFilterIsTheUnionOfListsThatAgree) {
    shader("test/start.comp", k_start_shader);
    for (const char* ratio : {"false", "true"}) {
        make(blocks(), light_above_blocks(),
             {{"visibility.ratio", ratio},
              {"visibility.depth_test", "plane"},
              {"vf_proxies.disc_scale", "4"},
              {"visibility.reach", "2"},
              {"visibility.rays", "8"}},
             R"("test.start":{"format":"rgba32f"},)", R"({"id":"start","type":"compute","shader":"test/start.comp"})");
        read_lists();
        ASSERT_EQ(size_, glm::ivec2(16));
        std::vector<float> start = run->read("test.start"), normal = run->read("gbuffer.normal"),
                           face = run->read("gbuffer.geometric_normal");
        auto three = [](const std::vector<float>& v, int i) { return glm::vec3(v[4 * i], v[4 * i + 1], v[4 * i + 2]); };
        const float tolerance = 0.01f * run->facts.bounds_over_animation.diagonal();
        size_t entries_in_all = 0, unsure = 0;
        for (int i = 0; i < 256; ++i) {
            glm::ivec2 at(i % 16, i / 16);
            CellCounts got = list(filtered_, filtered_capacity_, at), expected;
            bool sure = true;
            for (int y = std::max(at.y - 2, 0); y <= std::min(at.y + 2, 15); ++y)
                for (int x = std::max(at.x - 2, 0); x <= std::min(at.x + 2, 15); ++x) {
                    int k = y * 16 + x;
                    if (start[4 * i + 3] == 0 || start[4 * k + 3] == 0) continue;
                    float off = std::abs(glm::dot(three(face, i), three(start, k) - three(start, i)));
                    float cosine = glm::dot(three(normal, i), three(normal, k));
                    if (std::abs(off - tolerance) < 1e-5f || std::abs(cosine - 0.9f) < 1e-5f) sure = false;
                    if (off >= tolerance || cosine < 0.9f) continue;
                    for (const auto& [cell, counts] : list(lists_, capacity_, {x, y}))
                        expected[cell] += counts;
                }
            entries_in_all += got.size();
            if (sure)
                EXPECT_EQ(got, expected) << at.x << ", " << at.y;
            else
                ++unsure;
        }
        EXPECT_GT(entries_in_all, 300u);
        EXPECT_LT(unsure, 20u);
    }
}

/// What does not fit is counted, and lists grow until all fits.
TEST_F(VfMarch, ListsThatOverflowAreCountedAndGrow) {
    const VfSets kept{
        {"visibility.list_length", "2"}, {"visibility.filtered_length", "4"}, {"visibility.grow", "false"}};
    make(blocks(), light_above_blocks(), kept);
    std::vector<uint32_t> counts = run->read_buffer<uint32_t>("vf.counts");
    EXPECT_GT(counts[1], 0u);
    EXPECT_GT(counts[3], 0u);
    read_lists();
    EXPECT_EQ(capacity_, 2);
    EXPECT_EQ(filtered_capacity_, 4);
    VfSets grown = kept;
    grown[2].second = "true";
    make(blocks(), light_above_blocks(), grown);
    for (int frame = 0; frame < 4; ++frame)
        run->frame();
    counts = run->read_buffer<uint32_t>("vf.counts");
    EXPECT_EQ(counts[1], 0u);
    EXPECT_EQ(counts[3], 0u);
    read_lists();
    EXPECT_GE(capacity_, int(counts[0]));
    EXPECT_GE(filtered_capacity_, int(counts[2]));
}
