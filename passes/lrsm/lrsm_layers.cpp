// Layered reflective shadow maps (LRSM, sections 4.3 and 5): partitions, the table of stored layers, the build.
#include "graph/context.h"
#include "lrsm/partition.h"
#include "surface/shadow_views.h"

namespace bounce {

class LrsmLayersPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        for (const char* name : {"histogram", "partitions", "count", "table", "layers"})
            description.program(name, {std::string("lrsm/") + name + ".comp"});
        description.constant("pool_layers");
        ParameterSet& p = description.parameters;
        p.add("depth_layers", depth_layers_, {1, k_max_depth_layers}, "",
              "a + 1: parts that depth is cut into (at most, when adaptive)");
        p.add("normal_layers", normal_layers_, {1, k_max_normal_layers}, "",
              "b + 1: parts that the cosine between normal and light is cut into");
        p.add("adaptive", adaptive_, "boundaries from histograms of depth and cosine instead of equal parts");
        p.add("skip_empty", skip_empty_, "layers that hold no texel are neither stored nor sampled");
        p.add("pool", pool_, {0, 128}, "layers",
              "capacity in layers when empty ones are skipped; 0: all that there can be");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() ? "" : "the scene has no punctual light";
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        int views = shadow_view_count(d);
        int layers = std::max(views, 1) * depth_layers_ * normal_layers_;
        pool_layers_ = skip_empty_ && pool_ > 0 ? std::min(pool_, layers) : layers;
        // "A quarter" of the map counts texels.
        Extent extent("rsm.radiance.width / 2", "rsm.radiance.height / 2", std::to_string(pool_layers_));
        auto attribute = [&](const char* name, const char* format) {
            ResourceDeclaration& declared = d.creates(name, texture_2d_array, format, extent);
            declared.mips = "full";
        };
        attribute("lrsm.radiance", "rgba16f");
        attribute("lrsm.normal", "rgba16f");
        attribute("lrsm.depth", "rgba16");
        d.creates_buffer("lrsm.partitions", std::to_string(std::max(views, 1)), sizeof(LrsmPartition));
        int places = std::max(views, 1) * k_max_depth_layers * k_max_normal_layers;
        d.creates_buffer("lrsm.table", std::to_string(places), 4);
        d.creates_buffer("lrsm.summary", std::to_string(2 + std::max(views, 1)), 4);
        d.counts("layers stored, of " + std::to_string(layers), "lrsm.summary", 0);
        d.counts("layers without a place in the pool", "lrsm.summary", 1, true);
        for (int view = 0; view < views; ++view)
            d.counts("depth layers of view " + std::to_string(view), "lrsm.summary", 2 + uint64_t(view));
        if (adaptive_) {
            d.creates_buffer("lrsm.histogram", std::to_string(std::max(views, 1) * (256 + 64)), 4);
            d.uses("histogram");
        }
        if (skip_empty_) {
            d.creates_buffer("lrsm.counts", std::to_string(places), 4);
            d.uses("count");
        }
        for (const char* program : {"partitions", "table", "layers"})
            d.uses(program);
    }

    void execute(PassContext& c) override {
        c.set("pool_layers", pool_layers_);
        const GpuTexture& map = c.texture("rsm.radiance");
        glm::ivec3 size = map.desc().size;
        if (adaptive_) {
            c.dispatch("histogram", size);
            c.barrier();
        }
        c.dispatch("partitions", {size.z, 1, 1});
        c.barrier();
        if (skip_empty_) {
            c.dispatch("count", size);
            c.barrier();
        }
        c.dispatch("table", {1, 1, 1});
        c.barrier();
        c.dispatch("layers", {size.x / 2, size.y / 2, size.z});
    }

  private:
    int depth_layers_ = 2, normal_layers_ = 2;
    bool adaptive_ = false, skip_empty_ = false;
    int pool_ = 0, pool_layers_ = 1;
};

BOUNCE_REGISTER_PASS("lrsm_layers", LrsmLayersPass,
                     "cuts reflective shadow maps into layers by depth and by the cosine to the light")

} // namespace bounce
