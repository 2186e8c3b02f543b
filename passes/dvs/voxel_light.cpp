// Light at voxels: direct (DVS, section VI) and bounced (section IX).
#include "core/error.h"
#include "dvs/directional_filter.h"

#include <algorithm>

namespace bounce {

/// A radiance volume; behind the front sides' the back sides' when there are two. Over the list, only occupied voxels
/// are written.
static void create_radiance(Declaration& d, const std::string& name, const std::string& sides, bool occupied_only) {
    ResourceDeclaration& volume =
        d.creates(name, ResourceKind::texture_3d, "rgba16f",
                  {"voxels.albedo.width", "voxels.albedo.width", "voxels.albedo.width * " + sides});
    volume.overwritten = !occupied_only;
    volume.radiance = true;
}

/// Over the list of occupied voxels, or over all.
static void dispatch_voxels(PassContext& c, const std::string& program, bool occupied_only) {
    glm::ivec3 size = c.texture("voxels.albedo").desc().size;
    if (occupied_only)
        c.dispatch_indirect(program, "voxels.counts");
    else
        c.dispatch(program, size);
}

static const char* const k_occupied_only =
    "one invocation per occupied voxel; off: per voxel of the grid, as published";

class VoxelDirectPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("direct", {"dvs/direct.comp"});
        description.constant("emission_scale");
        description.parameters.add("occupied_only", occupied_only_, k_occupied_only);
        description.parameters.add("two_sided", two_sided_,
                                   "the sides of surfaces that face away from the averaged normal are lit, too");
    }
    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.lights() || facts.emissive_materials ? "" : "the scene has neither lights nor emissive materials";
    }
    void declare(Declaration& d) override {
        create_radiance(d, "dvs.radiance", two_sided_ ? "2" : "1", occupied_only_);
        d.uses("direct");
        d.reads("voxels.counts", Usage::indirect);
        emission_ = d.fact(&SceneFacts::emissive_materials) > 0;
    }
    void execute(PassContext& c) override {
        c.set("emission_scale", emission_ ? 1.0f : 0.0f);
        dispatch_voxels(c, "direct", occupied_only_);
    }

  private:
    bool occupied_only_ = true, two_sided_ = false, emission_ = false;
};

class VoxelBouncePass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("bounce", {"dvs/bounce.comp"});
        description.program("bounce_again", {"dvs/bounce_again.comp"});
        DirectionalFilter::describe(description);
        description.constant("two_sided");
        description.constant("environment_alone");
        description.parameters.add("occupied_only", occupied_only_, k_occupied_only);
        description.parameters.add("bounces", bounces_, {1, 8}, "",
                                   "indirect bounces; 2, as published: one between voxels, one at the pixel");
    }
    std::vector<std::pair<std::string, std::string>> fallbacks() const override {
        return {{"dvs.bounced", "dvs.radiance"}};
    }
    void declare(Declaration& d) override {
        create_radiance(d, "dvs.bounced", "(dvs.radiance.depth / dvs.radiance.width)", occupied_only_);
        d.uses("bounce");
        if (bounces_ > 2) {
            create_radiance(d, "dvs.previous", "(dvs.radiance.depth / dvs.radiance.width)", false);
            d.writes("dvs.previous", Usage::image); // by a copy
            d.uses("bounce_again");
            filter_.declare(d); // of what the bounce before sends
        }
        d.reads("voxels.counts", Usage::indirect);
    }
    void execute(PassContext& c) override {
        glm::ivec3 size = c.texture("dvs.bounced").desc().size;
        c.set("two_sided", size.z > size.x);
        // With one bounce, the one at the pixel, voxels send on the environment's light beside the direct one.
        c.set("environment_alone", bounces_ == 1);
        // The bounce after the next starts from what this one made.
        for (int bounce = 1; bounce < std::max(bounces_, 2); ++bounce) {
            if (bounce > 1) {
                if (c.has("dvs.directional")) filter_.run(c);
                c.barrier();
                glCopyImageSubData(c.texture("dvs.bounced").id(), GL_TEXTURE_3D, 0, 0, 0, 0,
                                   c.texture("dvs.previous").id(), GL_TEXTURE_3D, 0, 0, 0, 0, size.x, size.y, size.z);
            }
            dispatch_voxels(c, bounce == 1 ? "bounce" : "bounce_again", occupied_only_);
            c.barrier();
        }
    }

  private:
    bool occupied_only_ = true;
    int bounces_ = 2;
    DirectionalFilter filter_;
};

BOUNCE_REGISTER_PASS("voxel_direct", VoxelDirectPass, "direct light and emission that each voxel sends on")
BOUNCE_REGISTER_PASS("voxel_bounce", VoxelBouncePass, "diffuse light that bounces between voxels, by cones")

} // namespace bounce
