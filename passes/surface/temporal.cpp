// Accumulation over frames of what a gather made, with reprojection. The history is two arrays of layers in one, of
// which each frame reads one and writes the other. Where the gather is smaller than the picture, the graph file says so
// of what is made here, too.
#include "graph/context.h"

namespace bounce {

class TemporalPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("accumulate", {"surface/temporal.comp"});
        description.constant("turn");
        description.constant("something_moves");
    }

    std::vector<std::pair<std::string, std::string>> fallbacks() const override {
        return {{"temporal.output", "temporal.input"}};
    }

    void declare(Declaration& d) override {
        using enum ResourceKind;
        d.creates("temporal.output", texture_2d, "rgba16f", {}).radiance = true;
        d.creates("temporal.frames", texture_2d, "r16f", {}).neutral = glm::vec4(1);
        d.creates("temporal.history", texture_2d_array, "rgba32f", {"width", "height", "4"}).persistent = true;
        d.creates_buffer("temporal.counts", "3", 4);
        d.uses("accumulate");
        d.counts("frames held, at most", "temporal.counts", 0);
        d.counts("texels with history", "temporal.counts", 1);
        d.counts("texels with a surface", "temporal.counts", 2);
        something_moves_ = d.fact(&SceneFacts::dynamic_instances) > 0 || d.fact(&SceneFacts::animated_lights) > 0;
    }

    void execute(PassContext& c) override {
        turn_ = 1 - turn_;
        c.set("turn", turn_);
        c.set("something_moves", something_moves_);
        c.dispatch("accumulate", c.size("temporal.output"));
    }

  private:
    int turn_ = 1;
    bool something_moves_ = false;
};

BOUNCE_REGISTER_PASS("temporal", TemporalPass,
                     "the mean of a gather over frames, which follows the motion of camera and objects")

} // namespace bounce
