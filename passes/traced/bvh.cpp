// The scene's triangles as a bounding volume hierarchy for traced rays. Built on the CPU and kept while nothing but
// what moves changes; each frame then only ties the trees together anew.
#include "core/error.h"
#include "core/limits.h"
#include "gpu/capabilities.h"
#include "graph/context.h"
#include "traced/scene_trees.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr int64_t k_row = 8192; ///< texels of the texture's rows, as in glsl/traced/tree.glsl

int64_t limit_of(GLenum name) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value;
}

} // namespace

class BvhPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        ParameterSet& p = description.parameters;
        p.add("wide_nodes", wide_nodes_,
              "nodes of four children and a short stack, for GPUs; off: of one, without a stack");
        p.find("wide_nodes")->info.is_static = true; // shaders that name this pass by params_of walk by it
        p.add("leaf_size", leaf_size_, {1, k_max_leaf_triangles}, "triangles", "in a leaf, at most");
        p.add("share_all", share_all_, "each mesh has a tree that its copies share; off: only those that move");
    }

    void declare(Declaration& d) override {
        const auto triangles = double(d.fact(&SceneFacts::triangles));
        const uint64_t roots =
            1 + (share_all_ ? d.fact(&SceneFacts::instances) : d.fact(&SceneFacts::dynamic_instances));
        // Nodes differ from scene to scene; few have more than one for each triangle.
        const double per_triangle = 3 + (wide_nodes_ ? 3.0 : 8.0);
        const double wanted = std::max(double(top_texels(roots)) + std::ceil(triangles * per_triangle) + 4096, grown_);
        capacity_ = int64_t(wanted);
        if (wide_nodes_) {
            check(capacity_ * int64_t(sizeof(Texel)), limit_of(GL_MAX_SHADER_STORAGE_BLOCK_SIZE), "bytes of a buffer",
                  triangles);
            d.creates_buffer("traced.nodes", std::to_string(capacity_), sizeof(Texel)).incremental = true;
            d.writes("traced.nodes", Usage::storage);
        } else {
            const int64_t rows = (capacity_ + k_row - 1) / k_row;
            capacity_ = rows * k_row;
            check(rows, limit_of(GL_MAX_TEXTURE_SIZE), "rows of a texture", triangles);
            ResourceDeclaration& tree =
                d.creates("traced.tree", ResourceKind::texture_2d, "rgba32ui", Extent(int(k_row), int(rows)));
            tree.incremental = true;
            d.writes("traced.tree", Usage::image);
        }
        d.creates_buffer("traced.counts", std::to_string(k_counts), 4).overwritten = true;
        d.writes("traced.counts", Usage::storage);
        d.counts("triangles in trees", "traced.counts", 0);
        d.counts("nodes", "traced.counts", 1);
        d.counts("levels", "traced.counts", 2);
        d.counts("trees", "traced.counts", 3);
        d.counts("KiB of trees", "traced.counts", 4);
        d.counts("texels that trees lack", "traced.counts", 5, true);
    }

    bool outgrown(const std::vector<int64_t>& counted) override {
        if (counted.size() < k_counts || counted[5] <= 0) return false;
        grown_ = double(trees_.counts().texels);
        return true;
    }
    void forget_growth() override { grown_ = 0; }

    void execute(PassContext& c) override {
        const char* const slot = wide_nodes_ ? "traced.nodes" : "traced.tree";
        const bool built = build_trees(c);
        const std::vector<Texel> top = trees_.top(c.draws());
        const TreeCounts& counts = trees_.counts();
        const int64_t lacking = std::max<int64_t>(int64_t(counts.texels) - capacity_, 0);
        const bool whole = built || !c.stands(slot) || lacking > 0;
        if (lacking > 0) {
            write(c, 0, std::vector<Texel>(k_header_texels, Texel(0))); // no root: rays meet nothing
        } else {
            write(c, 0, top);
            if (whole) write(c, int64_t(counts.texels - trees_.rest().size()), trees_.rest());
        }
        const uint32_t told[k_counts] = {uint32_t(counts.triangles),
                                         uint32_t(counts.nodes),
                                         uint32_t(counts.depth),
                                         uint32_t(counts.trees),
                                         uint32_t(counts.texels * sizeof(Texel) / 1024),
                                         uint32_t(lacking)};
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

    /// Whether trees had to be built: anything but what moves by itself is new.
    bool build_trees(PassContext& c) {
        const TreeSettings settings{wide_nodes_ ? TreeLayout::wide : TreeLayout::threaded, leaf_size_, share_all_};
        std::vector<bool> alpha_matters;
        for (const Material& material : c.materials())
            alpha_matters.push_back(material.alpha_mode != AlphaMode::opaque);
        const Revision& geometry = c.revision(ScenePart::geometry);
        if (known_ && geometry == geometry_ && settings == settings_ && alpha_matters == alpha_matters_ &&
            trees_.fits(c.draws()))
            return false;
        known_ = false; // in case it fails
        trees_.build(c.read_vertices(), c.read_indices(), c.draws(), alpha_matters, settings);
        geometry_ = geometry, settings_ = settings, alpha_matters_ = alpha_matters, known_ = true;
        return true;
    }

    /// Texels from `first` on. A texture is filled row by row.
    void write(PassContext& c, int64_t first, const std::vector<Texel>& texels) const {
        if (texels.empty()) return;
        if (wide_nodes_) {
            c.buffer("traced.nodes")
                .update(uint64_t(first) * sizeof(Texel), texels.size() * sizeof(Texel), texels.data());
            return;
        }
        const GLuint texture = c.texture("traced.tree").id();
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

    bool wide_nodes_ = false, share_all_ = false;
    int leaf_size_ = 8;
    int64_t capacity_ = 0;
    double grown_ = 0;
    // What the trees were built from.
    bool known_ = false;
    Revision geometry_;
    TreeSettings settings_;
    std::vector<bool> alpha_matters_;
    SceneTrees trees_;
};

BOUNCE_REGISTER_PASS("bvh", BvhPass, "the scene's triangles as a bounding volume hierarchy, for traced rays")

} // namespace bounce
