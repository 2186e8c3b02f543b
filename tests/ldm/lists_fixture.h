#pragma once
// Layered depth maps as the graph left them, and what they should hold: triangles rasterized in double over the texels'
// centres.

#include "ldm/views.h"
#include "support/made_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

using Sets = std::vector<std::pair<std::string, std::string>>;

struct LdmFragment {
    float depth = 0;
    uint32_t depth_bits = 0, slope = 0, albedo = 0;
    bool operator==(const LdmFragment&) const = default;
};

/// The lists of the newest batch, read back.
struct LdmLists {
    explicit LdmLists(const SceneRunner& run) : LdmLists(run.graph) {}
    explicit LdmLists(const Graph& graph)
        : info(graph.buffer("ldm.info")->read_all<LdmInfo>()[0]), views(graph.buffer("ldm.views")->read_all<LdmView>()),
          words(graph.buffer(info.arrays ? "ldm.arrays" : "ldm.lists")->read_all<uint32_t>()) {}

    LdmInfo info;
    std::vector<LdmView> views;
    std::vector<uint32_t> words;

    /// In the order in which they are linked; empty where a link leads nowhere.
    std::vector<LdmFragment> list(int slot, int x, int y) const {
        std::vector<LdmFragment> fragments;
        size_t head = (size_t(slot) * size_t(info.resolution) + size_t(y)) * size_t(info.resolution) + size_t(x);
        auto add = [&](size_t at, size_t next) {
            LdmFragment f;
            f.depth_bits = words[at];
            std::memcpy(&f.depth, &f.depth_bits, 4);
            if (info.node_words > 2) f.slope = words[next];
            if (info.node_words > 3) f.albedo = words[next + 1];
            fragments.push_back(f);
        };
        if (info.arrays) {
            for (size_t i = words[head]; i < words[head + 1]; ++i) {
                size_t at = size_t(info.heads) + 1 + i * size_t(info.node_words - 1);
                add(at, at + 1);
            }
            return fragments;
        }
        for (uint32_t node = words[head]; node != 0 && fragments.size() < 100000;) {
            size_t at = size_t(info.heads) + size_t(node - 1) * size_t(info.node_words);
            if (at + size_t(info.node_words) > words.size()) return {};
            add(at, at + 2);
            node = words[at + 1];
        }
        return fragments;
    }
    /// All lists in a row, each begun by its length: the same whatever order the fragments came in.
    std::vector<uint32_t> canonical() const {
        std::vector<uint32_t> all;
        for (int head = 0; head < info.heads; ++head) {
            int n = info.resolution;
            std::vector<LdmFragment> fragments = list(head / (n * n), head % n, head / n % n);
            all.push_back(uint32_t(fragments.size()));
            for (const LdmFragment& f : fragments)
                all.insert(all.end(), {f.depth_bits, f.slope, f.albedo});
        }
        return all;
    }
};

/// How far a fragment is from being rejected by its alpha (below 0: it is), given its first texture coordinates and the
/// vertices' alpha; texels where that is nearer to 0 than `border` are left out.
struct AlphaTest {
    std::function<double(glm::dvec2 uv, double alpha)> margin;
    double border = 0;
};

/// What map `view` should hold.
class LdmOracle {
  public:
    /// Tolerance of depths: the rasterizer moves corners by its snapping, and so depths by their slopes times that; and
    /// the last bits of floats.
    static constexpr double k_snap = 1.0 / 128, k_last_bits = 1.0 / (1 << 22);
    struct Fragment {
        double depth, tolerance;
        glm::dvec2 slope;
    };
    struct Texel {
        std::vector<Fragment> fragments; ///< by depth
        bool excluded = false;           ///< an edge is within k_snap of its centre
    };

    LdmOracle(const Scene& scene, const SceneState& state, const LdmView& view, int side, const AlphaTest& alpha = {})
        : resolution(side), texels(size_t(side) * size_t(side)) {
        for (const Instance& instance : state.instances) {
            for (uint32_t i = 0; i + 2 < instance.primitive.index_count; i += 3) {
                std::array<glm::dvec3, 3> p;
                std::array<const Vertex*, 3> corners;
                for (uint32_t k = 0; k < 3; ++k) {
                    corners[k] = &scene.vertices[scene.indices[instance.primitive.first_index + i + k]];
                    glm::dvec4 world = glm::dmat4(instance.world) * glm::dvec4(glm::dvec3(corners[k]->position), 1);
                    p[k] = {glm::dot(glm::dvec4(view.to_x), world), glm::dot(glm::dvec4(view.to_y), world),
                            glm::dot(glm::dvec4(view.to_z), world)};
                }
                bool masked = scene.materials[size_t(instance.primitive.material)].alpha_mode == AlphaMode::mask;
                add(p, corners, masked && alpha.margin ? &alpha : nullptr);
            }
        }
        for (Texel& texel : texels)
            std::sort(texel.fragments.begin(), texel.fragments.end(),
                      [](const Fragment& a, const Fragment& b) { return a.depth < b.depth; });
    }

    const Texel& at(int x, int y) const { return texels[size_t(y) * size_t(resolution) + size_t(x)]; }

    int resolution;
    std::vector<Texel> texels;

  private:
    void add(const std::array<glm::dvec3, 3>& p, const std::array<const Vertex*, 3>& corners, const AlphaTest* alpha) {
        glm::dvec2 low = glm::min(glm::min(glm::dvec2(p[0]), glm::dvec2(p[1])), glm::dvec2(p[2])),
                   high = glm::max(glm::max(glm::dvec2(p[0]), glm::dvec2(p[1])), glm::dvec2(p[2]));
        glm::ivec2 from = glm::max(glm::ivec2(glm::floor(low - 1.0)), 0),
                   to = glm::min(glm::ivec2(glm::floor(high + 1.0)), resolution - 1);
        glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
        double area = e1.x * e2.y - e1.y * e2.x;
        glm::dvec2 slope((e1.z * e2.y - e2.z * e1.y) / area, (e2.z * e1.x - e1.z * e2.x) / area);
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                Texel& texel = texels[size_t(y) * size_t(resolution) + size_t(x)];
                glm::dvec2 c(x + 0.5, y + 0.5);
                bool inside = true;
                std::array<double, 3> weight{};
                for (int k = 0; k < 3; ++k) {
                    glm::dvec2 a(p[size_t(k)]), along = glm::dvec2(p[size_t((k + 1) % 3)]) - a, d = c - a;
                    double share = std::clamp(glm::dot(d, along) / std::max(glm::dot(along, along), 1e-300), 0.0, 1.0);
                    if (glm::distance(d, share * along) <= k_snap) texel.excluded = true;
                    double side = (along.x * d.y - along.y * d.x) / area;
                    weight[size_t((k + 2) % 3)] = side;
                    if (!(side > 0)) inside = false; // also where the area is 0
                }
                if (!inside) continue;
                if (alpha) {
                    glm::dvec2 uv(0);
                    double vertex_alpha = 0;
                    for (size_t k = 0; k < 3; ++k) {
                        uv += weight[k] * glm::dvec2(corners[k]->u0, corners[k]->v0);
                        vertex_alpha += weight[k] * double(corners[k]->colour_ba >> 16) / 65535;
                    }
                    double margin = alpha->margin(uv, vertex_alpha);
                    if (std::abs(margin) < alpha->border) texel.excluded = true;
                    if (margin < 0) continue;
                }
                texel.fragments.push_back({p[0].z + glm::dot(slope, c - glm::dvec2(p[0])),
                                           (std::abs(slope.x) + std::abs(slope.y)) * k_snap + k_last_bits, slope});
            }
        }
    }
};

struct LdmComparison {
    int texels = 0, excluded = 0, wrong = 0;
    size_t fragments = 0, longest = 0;
    int slopes = 0, wrong_slopes = 0;
    std::string first_wrong;
    double excluded_share() const { return double(excluded) / std::max(texels, 1); }
};

/// As multisets and in order: the i-th smallest of depths that may each be off by a tolerance lies between the i-th
/// smallest lower and the i-th smallest upper bound.
inline void compare_list(const std::vector<LdmFragment>& got, const LdmOracle::Texel& wanted, const LdmInfo& info,
                         LdmComparison& count, const std::string& where) {
    std::vector<double> lower, upper;
    for (const LdmOracle::Fragment& f : wanted.fragments) {
        lower.push_back(f.depth - f.tolerance);
        upper.push_back(f.depth + f.tolerance);
    }
    std::sort(lower.begin(), lower.end());
    std::sort(upper.begin(), upper.end());
    std::string fault;
    if (got.size() != lower.size()) fault = fmt::format("{} fragments instead of {}", got.size(), lower.size());
    for (size_t i = 0; fault.empty() && i < got.size(); ++i) {
        if (i > 0 && got[i].depth < got[i - 1].depth) fault = "not in order";
        if (got[i].depth < lower[i] || got[i].depth > upper[i])
            fault = fmt::format("fragment {}: depth {} is not within {} … {}", i, got[i].depth, lower[i], upper[i]);
    }
    count.wrong += !fault.empty();
    if (!fault.empty() && count.first_wrong.empty()) count.first_wrong = where + ": " + fault;
    count.fragments += lower.size();
    count.longest = std::max(count.longest, lower.size());
    if (info.node_words < 3 || !fault.empty()) return;
    // Slopes, where neighbours in depth cannot be taken for one another.
    const auto& w = wanted.fragments;
    for (size_t i = 0; i < w.size(); ++i) {
        double apart = 2 * w[i].tolerance;
        if ((i > 0 && w[i].depth - w[i - 1].depth < apart + 2 * w[i - 1].tolerance) ||
            (i + 1 < w.size() && w[i + 1].depth - w[i].depth < apart + 2 * w[i + 1].tolerance))
            continue;
        auto half = [](uint32_t bits) {
            double mantissa = (bits & 1023u) / 1024.0, sign = bits & 0x8000u ? -1 : 1;
            int exponent = int(bits >> 10 & 31u);
            return sign * (exponent ? (1 + mantissa) * std::exp2(exponent - 15) : mantissa * std::exp2(-14));
        };
        glm::dvec2 slope(half(got[i].slope & 0xffffu), half(got[i].slope >> 16)),
            clamped = glm::clamp(w[i].slope, -4.0, 4.0);
        ++count.slopes;
        // Snapped corners turn the planes of small triangles a little.
        double allowed = 0.1 * (std::abs(w[i].slope.x) + std::abs(w[i].slope.y)) + 1e-4;
        if (std::abs(slope.x - clamped.x) > allowed || std::abs(slope.y - clamped.y) > allowed) ++count.wrong_slopes;
    }
}

/// Every map of the one batch that `run` has built.
inline LdmComparison compare_lists(const SceneRunner& run, const AlphaTest& alpha = {}) {
    LdmLists lists(run);
    LdmComparison count;
    EXPECT_EQ(lists.info.batches, 1);
    int n = lists.info.resolution;
    for (int map = 0; map < lists.info.maps; ++map) {
        LdmOracle oracle(run.scene, run.state, lists.views[size_t(map)], n, alpha);
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                ++count.texels;
                if (oracle.at(x, y).excluded) {
                    ++count.excluded;
                    continue;
                }
                compare_list(lists.list(map, x, y), oracle.at(x, y), lists.info, count,
                             fmt::format("map {} texel {}, {}", map, x, y));
            }
        }
    }
    return count;
}

class LdmTest : public SceneGraphTest {
  protected:
    static constexpr const char* k_maps_alone = R"("passes":[{"type":"ldm"}])";
    static constexpr const char* k_occlusion = R"("resources":{"ldm.openness":{"format":"rg32f","clear":false},
        "out.ambient_occlusion":{"format":"r32f","neutral":[1,1,1,1],"clear":false},
        "out.ambient_occlusion_dmax":{"format":"r32f","neutral":[1,1,1,1],"clear":false}},
        "passes":[{"type":"gbuffer"},{"type":"ldm"},
        {"id":"ambient_occlusion","type":"compute","shader":"ldm/ambient_occlusion.comp",
         "repeat":{"over":"count","count":"ldm.batches.count","loop":"ldm"}},
        {"id":"finish","type":"compute","shader":"ldm/finish_ambient_occlusion.comp","dispatch":"out.ambient_occlusion"}])";

    /// A frame, and again as long as a pass had too little room. Returns how often.
    static int whole_frame(SceneRunner& run) {
        run.frame();
        int grown = 0;
        while (run.graph.needs_larger_buffers() && grown < 8) {
            ++grown;
            run.frame();
        }
        return grown;
    }
    static int64_t counter(const SceneRunner& run, const std::string& label) {
        for (const CounterValue& counter : run.graph.counters())
            if (counter.label == label) return counter.value;
        ADD_FAILURE() << "no counter '" << label << "'";
        return -1;
    }
    static Camera towards_blocks() {
        Camera camera;
        camera.position = {1.9f, 1.7f, 2.6f};
        camera.target = {0, 0.3f, 0};
        return camera;
    }
};

} // namespace bounce
