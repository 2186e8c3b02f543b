#pragma once
// The OpenGL objects behind a plan's resources, kept from plan to plan where name and shape stay the same.

#include "graph/plan.h"

#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace bounce {

class Allocations {
  public:
    /// Makes what `plan` needs and lets go of what it does not. Returns true when anything persistent is new (so that
    /// history is void). Throws Error when memory does not suffice; the old objects are then still there.
    bool update(const Plan& plan);

    const GpuTexture& texture(int resource, bool previous = false) const;
    const Buffer& buffer(int resource, bool previous = false) const;
    /// A view of one mip (−1: all) and one layer (−1: all) as a sampler of that kind wants it.
    const GpuTexture& view(int resource, bool previous, int mip, int layer, bool as_2d);
    const Framebuffer& framebuffer(const std::vector<std::tuple<int, int, int>>& colours,
                                   std::tuple<int, int, int> depth, glm::ivec2 size);
    void clear(int resource, glm::vec4 value) const;
    /// This frame's content becomes last frame's.
    void keep_previous(const Plan& plan) const;
    void reset(const Plan& plan) const;

  private:
    struct Entry {
        std::string name;
        TextureDesc desc;
        uint64_t bytes = 0;
        bool is_buffer = false;
        GpuTexture texture, previous_texture;
        Buffer buffer, previous_buffer;
        std::map<std::tuple<bool, int, int, bool>, GpuTexture> views;
    };
    std::vector<std::unique_ptr<Entry>> entries_;
    std::map<std::vector<int>, Framebuffer> framebuffers_;
};

} // namespace bounce
