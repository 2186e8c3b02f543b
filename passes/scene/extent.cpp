#include "scene/extent.h"

#include "scene/extent_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bounce {

namespace {

constexpr double k_outlying_share = 1e-4; // rule 2: of area and emission
constexpr float k_worth = 4;              // rule 2: by how much the bounds must shrink
constexpr float k_stage = 8;              // rule 3: how many times its size from the stage
constexpr double k_seen_share = 1.0 / 16;

/// ScenePieces that belong to the scene so far.
struct Limits {
    float reach = std::numeric_limits<float>::infinity(); ///< shorter ones
    std::vector<std::pair<glm::vec3, float>> rooms;       ///< inside all of these cubes: centre, half edge
    Bounds stage;                                         ///< moving ones inside; empty: anywhere

    bool hold(const ScenePiece& piece) const {
        if (!(piece.reach < reach)) return false;
        for (const auto& [centre, half] : rooms)
            if (!(farthest(piece.box, centre) <= half)) return false;
        if (stage.empty() || !piece.moving) return true;
        return glm::all(glm::greaterThanEqual(piece.box.min, stage.min)) &&
               glm::all(glm::lessThanEqual(piece.box.max, stage.max));
    }
    static float farthest(const Bounds& box, const glm::vec3& from) {
        glm::vec3 far = glm::max(glm::abs(box.min - from), glm::abs(box.max - from));
        return std::max({far.x, far.y, far.z});
    }
};

class Trimmer {
  public:
    Trimmer(const ScenePieces& pieces, std::span<const Camera> views) : pieces_(pieces), views_(views) {}

    SceneExtent trim() {
        visit_held([&](const ScenePiece& piece) { all_.add(piece); });
        SceneExtent extent;
        extent.whole = all_.box;
        extent.triangles = size_t(std::llround(all_.triangles));
        // Each round makes the bounds several times shorter, which floats do not allow often.
        bool trimmed = false;
        for (int round = 0; round < 32 && all_.triangles > 0 && leave_out_some(); ++round)
            trimmed = true;
        extent.bounds = all_.box;
        if (trimmed)
            pieces_.visit([&](const ScenePiece& piece) {
                if (!limits_.hold(piece)) ++(piece.moving ? extent.stray_moving_boxes : extent.stray_triangles);
            });
        return extent;
    }

  private:
    template <class See>
    void visit_held(See&& see) const {
        pieces_.visit([&](const ScenePiece& piece) {
            if (limits_.hold(piece)) see(piece);
        });
    }

    /// What one pass tells of all three rules.
    struct Survey {
        PieceSum compact; ///< without the triangles that span the bounds
        Bounds stage;
        static constexpr int k_slabs = 16;
        std::array<double, k_slabs> area{}; ///< along the longest edge
    };
    Survey survey() const {
        Survey out;
        glm::vec3 edges = all_.box.size();
        int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : (edges.y >= edges.z ? 1 : 2);
        float longest = edges[axis], low = all_.box.min[axis];
        visit_held([&](const ScenePiece& piece) {
            if (piece.reach < k_spanning_share * longest) out.compact.add(piece);
            if (!piece.later) out.stage.add(piece.box);
            float at = 0.5f * piece.box.min[axis] + 0.5f * piece.box.max[axis];
            int slab = longest > 0 ? int(float(Survey::k_slabs) * ((at - low) / longest)) : 0;
            out.area[size_t(std::clamp(slab, 0, Survey::k_slabs - 1))] += piece.area;
        });
        return out;
    }

    bool leave_out_some() {
        Survey seen = survey();
        return leave_out_spanning(seen) || leave_out_moving(seen) || leave_out_outlying(seen);
    }

    bool seen(const Bounds& kept) const {
        return std::all_of(views_.begin(), views_.end(), [&](const Camera& view) {
            glm::vec3 nearest = glm::clamp(view.position, kept.min, kept.max);
            double height = 2.0 * glm::distance(view.position, nearest) * std::tan(0.5 * double(view.vfov));
            return longest_edge(kept) >= k_seen_share * height;
        });
    }

    /// Goes on with what `limits` hold if that is a scene of its own.
    bool take(const Limits& limits, const PieceSum& kept) {
        if (kept.triangles <= 0 || !seen(kept.box)) return false;
        limits_ = limits;
        all_ = kept;
        return true;
    }

    bool keeps_emission(const PieceSum& kept) const {
        return all_.emission - kept.emission <= k_outlying_share * all_.emission;
    }

    bool leave_out_spanning(const Survey& seen) {
        const PieceSum& kept = seen.compact;
        bool few = all_.triangles - kept.triangles <= k_few_strays * all_.triangles;
        if (!few || longest_edge(kept.box) * k_collapse > longest_edge(all_.box) || !keeps_emission(kept)) return false;
        Limits limits = limits_;
        limits.reach = k_spanning_share * longest_edge(all_.box);
        return take(limits, kept);
    }

    bool leave_out_moving(const Survey& seen) {
        if (!pieces_.moves() || !limits_.stage.empty() || seen.stage.empty()) return false;
        float margin = k_stage * longest_edge(seen.stage);
        Limits limits = limits_;
        limits.stage = {seen.stage.min - margin, seen.stage.max + margin};
        PieceSum kept;
        visit_held([&](const ScenePiece& piece) {
            if (limits.hold(piece)) kept.add(piece);
        });
        bool few = all_.area - kept.area <= k_few_strays * all_.area;
        return few && longest_edge(kept.box) * k_collapse <= longest_edge(all_.box) && take(limits, kept);
    }

    /// The middle of the area: the median of points spread evenly over it, along each axis.
    glm::vec3 middle() const {
        constexpr int k_points = 1025;
        std::array<std::vector<float>, 3> places;
        double passed = 0;
        int next = 0;
        visit_held([&](const ScenePiece& piece) {
            passed += piece.area;
            for (; next < k_points && passed >= all_.area * ((next + 0.5) / k_points); ++next)
                for (int axis = 0; axis < 3; ++axis)
                    places[size_t(axis)].push_back(0.5f * piece.box.min[axis] + 0.5f * piece.box.max[axis]);
        });
        glm::vec3 out(0);
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<float>& line = places[size_t(axis)];
            if (line.empty()) continue;
            std::nth_element(line.begin(), line.begin() + long(line.size() / 2), line.end());
            out[axis] = line[line.size() / 2];
        }
        return out;
    }

    /// Whether all but so little area may lie in a box of a k_worth-th of the bounds.
    bool may_outlie(const Survey& seen) const {
        constexpr int k_window = int(Survey::k_slabs / k_worth) + 1;
        for (int first = 0; first + k_window <= Survey::k_slabs; ++first) {
            double inside = 0;
            for (int i = 0; i < k_window; ++i)
                inside += seen.area[size_t(first + i)];
            if (all_.area - inside <= 2 * k_outlying_share * all_.area) return true;
        }
        return false;
    }

    bool leave_out_outlying(const Survey& seen) {
        if (!(all_.area > 0) || !std::isfinite(all_.area) || !may_outlie(seen)) return false;
        glm::vec3 centre = middle();
        // Shells around the middle, four to a doubling of the radius.
        constexpr int k_zero = 640, k_shells = 2 * k_zero;
        auto radius = [](int shell) { return std::exp2(float(shell + 1 - k_zero) / 4); };
        std::vector<PieceSum> shells(k_shells);
        visit_held([&](const ScenePiece& piece) {
            float far = Limits::farthest(piece.box, centre);
            int shell = far > 0 ? int(std::floor(4 * std::log2(far))) + k_zero : 0;
            shell = std::clamp(shell, 0, k_shells - 1);
            while (shell + 1 < k_shells && !(far <= radius(shell)))
                ++shell;
            shells[size_t(shell)].add(piece);
        });
        std::vector<PieceSum> inside(k_shells);
        inside[0] = shells[0];
        for (size_t i = 1; i < k_shells; ++i)
            inside[i] = inside[i - 1], inside[i].add(shells[i]);
        float longest = longest_edge(all_.box);
        int cut = k_shells;
        for (int i = k_shells - 1; i >= 0; --i) {
            const PieceSum& kept = inside[size_t(i)];
            if (all_.area - kept.area > k_outlying_share * all_.area || !keeps_emission(kept)) break;
            if (longest_edge(kept.box) * k_worth > longest) continue;
            longest = longest_edge(kept.box);
            cut = i;
        }
        if (cut == k_shells) return false;
        Limits limits = limits_;
        limits.rooms.emplace_back(centre, radius(cut));
        return take(limits, inside[size_t(cut)]);
    }

    const ScenePieces& pieces_;
    std::span<const Camera> views_;
    Limits limits_;
    PieceSum all_;
};

} // namespace

float longest_edge(const Bounds& bounds) {
    if (bounds.empty()) return 0;
    glm::vec3 edges = bounds.size();
    return std::max({edges.x, edges.y, edges.z});
}

SceneExtent scene_extent(const Scene& scene, float time, std::span<const Camera> views) {
    ScenePieces pieces(scene, time, false);
    return Trimmer(pieces, views).trim();
}

SceneExtent scene_extent_over_animation(const Scene& scene, std::span<const Camera> views) {
    ScenePieces pieces(scene, 0, true);
    return Trimmer(pieces, views).trim();
}

} // namespace bounce
