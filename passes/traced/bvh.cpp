// The scene's triangles as a bounding volume hierarchy for traced rays. Built on the CPU and kept while nothing but
// what moves changes; each frame then only ties the trees together anew.
#include "core/error.h"
#include "core/limits.h"
#include "gpu/driver_limits.h"
#include "graph/context.h"
#include "traced/scene_trees.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int64_t k_row = 8192; ///< texels of the texture's rows, as in glsl/traced/tree.glsl

} // namespace

class BvhPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        ParameterSet& p = description.parameters;
        p.add("wide_nodes", wide_nodes_,
              "nodes of four children and a short stack, for GPUs; off: of one, without a stack");
        p.find("wide_nodes")->info.is_static = true; // shaders that name this pass by params_of walk by it
        p.add("leaf_size", leaf_size_, {1, k_max_leaf_triangles}, "triangles", "in a leaf, at most");
        p.add("cut", cut_, "large triangles may lie in several leaves: fewer visits, a longer build");
        p.add("share_all", share_all_, "each mesh has a tree that its copies share; off: only those that move");
    }

    void declare(Declaration& d) override {
        const auto triangles = double(d.fact(&SceneFacts::triangles));
        const uint64_t roots =
            1 + (share_all_ ? d.fact(&SceneFacts::instances) : d.fact(&SceneFacts::dynamic_instances));
        alpha_ = d.fact(&SceneFacts::alpha_tested_materials) + d.fact(&SceneFacts::blended_materials) > 0;
        // A triangle takes three texels. Nodes differ from scene to scene; few have more than one for two triangles.
        const double per_triangle = (cut_ ? 4.5 : 3) + (wide_nodes_ ? 1.5 : 4.0);
        tree_capacity_ =
            std::max(int64_t(top_texels(roots)) + int64_t(std::ceil(triangles * per_triangle)) + 4096, tree_grown_);
        if (wide_nodes_) {
            check(tree_capacity_ * int64_t(sizeof(Texel)), driver_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE),
                  "bytes of a buffer", triangles);
            d.creates_buffer("traced.nodes", std::to_string(tree_capacity_), sizeof(Texel)).incremental = true;
            d.writes("traced.nodes", Usage::storage);
        } else {
            tree_capacity_ = declare_texture(d, "traced.tree", tree_capacity_, triangles);
        }
        // With alpha, three texels more; few scenes have more of these than a third.
        if (alpha_)
            alpha_capacity_ = declare_texture(d, "traced.alpha",
                                              std::max(int64_t(std::ceil(triangles)) + 4096, alpha_grown_), triangles);
        d.creates_buffer("traced.counts", std::to_string(k_counts), 4).overwritten = true;
        d.writes("traced.counts", Usage::storage);
        d.counts("triangles in trees", "traced.counts", 0);
        d.counts("nodes", "traced.counts", 1);
        d.counts("levels", "traced.counts", 2);
        d.counts("trees", "traced.counts", 3);
        d.counts("KiB of trees", "traced.counts", 4);
        d.counts("texels that trees lack", "traced.counts", 5, true);
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        if (counted.size() < k_counts || counted[5] <= 0) return false;
        tree_grown_ = int64_t(trees_.counts().texels);
        alpha_grown_ = int64_t(trees_.alpha().size());
        return true;
    }
    void reset_capacity() override { tree_grown_ = alpha_grown_ = 0; }

    void execute(PassContext& c) override {
        const char* const slot = wide_nodes_ ? "traced.nodes" : "traced.tree";
        const bool built = build_trees(c);
        const std::vector<Texel> top = trees_.top(c.draws());
        const TreeCounts& counts = trees_.counts();
        const int64_t lacking = std::max<int64_t>(int64_t(counts.texels) - tree_capacity_, 0) +
                                std::max<int64_t>(int64_t(trees_.alpha().size()) - (alpha_ ? alpha_capacity_ : 0), 0);
        if (lacking > 0) {
            write(c, slot, 0, std::vector<Texel>(k_header_texels, Texel(0))); // no root: rays meet nothing
        } else {
            write(c, slot, 0, top);
            if (built || !c.stands(slot) || lacked_)
                write(c, slot, int64_t(counts.texels - trees_.rest().size()), trees_.rest());
            if (alpha_ && (built || !c.stands("traced.alpha") || lacked_)) write(c, "traced.alpha", 0, trees_.alpha());
        }
        lacked_ = lacking > 0;
        const uint64_t bytes = (counts.texels + trees_.alpha().size()) * sizeof(Texel);
        const uint32_t told[k_counts] = {uint32_t(counts.triangles), uint32_t(counts.nodes), uint32_t(counts.depth),
                                         uint32_t(counts.trees),     uint32_t(bytes / 1024), uint32_t(lacking)};
        c.buffer("traced.counts").update(0, sizeof(told), told);
    }

  private:
    static constexpr size_t k_counts = 6;

    static void check(int64_t needed, int64_t limit, const char* what, double triangles) {
        if (needed > limit)
            throw Error(fmt::format("invalid scene for traced rays: its {} triangles take {} {}: expected at most {}",
                                    grouped(uint64_t(triangles)), grouped(uint64_t(needed)), what,
                                    grouped(uint64_t(limit))));
    }

    /// Rows of texels; returns how many fit.
    static int64_t declare_texture(Declaration& d, const char* name, int64_t texels, double triangles) {
        const int64_t rows = (texels + k_row - 1) / k_row;
        check(rows, driver_limit(GL_MAX_TEXTURE_SIZE), "rows of a texture", triangles);
        d.creates(name, ResourceKind::texture_2d, "rgba32ui", Extent(int(k_row), int(rows))).incremental = true;
        d.writes(name, Usage::image);
        return rows * k_row;
    }

    /// Whether trees had to be built: anything but what moves by itself is new.
    bool build_trees(PassContext& c) {
        const TreeSettings settings{wide_nodes_ ? TreeLayout::wide : TreeLayout::threaded, leaf_size_, cut_,
                                    share_all_};
        const std::vector<AlphaSource> alpha = alpha_sources(c.materials());
        const Revision& geometry = c.revision(ScenePart::geometry);
        if (known_ && geometry == geometry_ && settings == settings_ && alpha == alpha_sources_ &&
            trees_.fits(c.draws()))
            return false;
        known_ = false; // in case it fails
        trees_.build(c.read_vertices(), c.read_indices(), c.draws(), alpha, settings);
        geometry_ = geometry, settings_ = settings, alpha_sources_ = alpha, known_ = true;
        return true;
    }

    /// Texels of a slot's resource from `first` on. A texture is filled row by row.
    static void write(PassContext& c, const std::string& slot, int64_t first, const std::vector<Texel>& texels) {
        if (texels.empty()) return;
        if (slot == "traced.nodes") {
            c.buffer(slot).update(uint64_t(first) * sizeof(Texel), texels.size() * sizeof(Texel), texels.data());
            return;
        }
        const GLuint texture = c.texture(slot).id();
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        auto part = [&](int64_t from, int64_t x, int64_t y, int64_t width, int64_t height) {
            glTextureSubImage2D(texture, 0, GLint(x), GLint(y), GLsizei(width), GLsizei(height), GL_RGBA_INTEGER,
                                GL_UNSIGNED_INT, &texels[size_t(from)]);
        };
        const int64_t count = int64_t(texels.size());
        int64_t done = 0;
        while (done < count) {
            const int64_t x = (first + done) % k_row, y = (first + done) / k_row, left = count - done;
            const int64_t rows = x == 0 ? left / k_row : 0;
            const int64_t width = rows > 0 ? k_row : std::min(left, k_row - x);
            part(done, x, y, width, std::max<int64_t>(rows, 1));
            done += width * std::max<int64_t>(rows, 1);
        }
    }

    bool wide_nodes_ = false, share_all_ = false, cut_ = true;
    int leaf_size_ = 8;
    bool alpha_ = false, lacked_ = false;
    int64_t tree_capacity_ = 0, alpha_capacity_ = 0, tree_grown_ = 0, alpha_grown_ = 0;
    // What the trees were built from.
    bool known_ = false;
    Revision geometry_;
    TreeSettings settings_;
    std::vector<AlphaSource> alpha_sources_;
    SceneTrees trees_;
};

BOUNCE_REGISTER_PASS("bvh", BvhPass, "the scene's triangles as a bounding volume hierarchy, for traced rays")

} // namespace bounce
