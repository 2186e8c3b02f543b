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
    /// Makes what `plan` needs, cleared, and lets go of what it does not. Throws Error when memory does not suffice;
    /// the old objects are then still there.
    void update(const Plan& plan);
    /// Lets go of everything.
    void release();
    /// Differs between any two objects that ever stood for a resource.
    uint64_t serial(int resource) const { return entries_[size_t(resource)]->serial; }

    const GpuTexture& texture(int resource, bool previous = false) const;
    const Buffer& buffer(int resource, bool previous = false) const;
    /// A view of one mip (−1: all) and one layer (−1: all) as a sampler of that kind wants it.
    const GpuTexture& view(int resource, bool previous, int mip, int layer, bool as_2d);
    const Framebuffer& framebuffer(const std::vector<std::tuple<int, int, int>>& colours,
                                   std::tuple<int, int, int> depth, glm::ivec2 size);
    void clear(int resource, glm::vec4 value) const;
    /// This frame's content of that resource becomes last frame's.
    void keep_previous(int resource) const;
    /// What earlier frames left of that resource is cleared: itself if it is kept, and last frame's copy.
    void reset(const Plan& plan, int resource) const;

  private:
    struct Entry {
        std::string name;
        uint64_t serial = 0;
        TextureDesc desc;
        uint64_t bytes = 0;
        bool is_buffer = false;
        GpuTexture texture, previous_texture;
        Buffer buffer, previous_buffer;
        std::map<std::tuple<bool, int, int, bool>, GpuTexture> views;
    };
    std::vector<std::unique_ptr<Entry>> entries_;
    std::map<std::vector<int>, Framebuffer> framebuffers_;
    uint64_t made_ = 0; ///< entries so far
};

} // namespace bounce
