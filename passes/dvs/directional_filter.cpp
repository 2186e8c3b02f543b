#include "dvs/directional_filter.h"

namespace bounce {

void DirectionalFilter::describe(PassDescription& description) {
    for (const char* name : {"leaves", "base_mips", "chain_mips"})
        description.program(name, {std::string("dvs/") + name + ".comp"});
}

void DirectionalFilter::declare(Declaration& d) const {
    for (const char* program : {"leaves", "base_mips", "chain_mips"})
        d.uses(program);
    d.reads("voxels.counts", Usage::indirect);
}

void DirectionalFilter::run(PassContext& c) const {
    const TextureDesc& directional = c.texture("dvs.directional").desc();
    bool leaves = directional.size.z == c.texture("voxels.normal").desc().size.z;
    c.bind_mip("dvs.directional", 0);
    if (leaves)
        c.dispatch_indirect("leaves", "voxels.counts");
    else
        c.dispatch("base_mips", c.texture("voxels.bricks").desc().size);
    for (int mip = 1; mip < directional.mips; ++mip) {
        c.barrier();
        c.bind_mip("dvs.directional", mip);
        c.bind_mip("dvs.finer", mip - 1); // a view of it alone: what is written is not bound to be read
        c.dispatch("chain_mips", glm::ivec3(directional.size.z >> mip));
    }
    c.barrier();
}

namespace {

class VoxelFilterPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        DirectionalFilter::describe(description);
        description.parameters.add("directional_leaves", directional_leaves_,
                                   "six directional volumes from the base level on, not from half the resolution");
    }
    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() || facts.emissive_materials ? "" : "the scene has neither lights nor emissive materials";
    }
    void declare(Declaration& d) override {
        std::string tile = directional_leaves_ ? "voxels.albedo.width" : "max(1, voxels.albedo.width / 2)";
        ResourceDeclaration& directional =
            d.creates("dvs.directional", ResourceKind::texture_3d, "rgba16f", {"2 * " + tile, "3 * " + tile, tile});
        directional.radiance = true;
        directional.mips = "rint(log2(" + tile + ")) + 1";
        filter_.declare(d);
    }
    void execute(PassContext& c) override { filter_.run(c); }

  private:
    DirectionalFilter filter_;
    bool directional_leaves_ = false;
};

} // namespace

BOUNCE_REGISTER_PASS("voxel_filter", VoxelFilterPass,
                     "six directional volumes of the light that voxels send and block, with their mips")

} // namespace bounce
