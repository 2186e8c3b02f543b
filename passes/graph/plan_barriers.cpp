// Where a plan needs memory barriers.
#include "graph/plan.h"

#include <map>
#include <set>

namespace bounce {

static GLbitfield barrier_for(Usage usage) {
    switch (usage) {
    case Usage::sampled:
        return GL_TEXTURE_FETCH_BARRIER_BIT;
    case Usage::image:
        return GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
    case Usage::storage:
        return GL_SHADER_STORAGE_BARRIER_BIT;
    case Usage::colour:
    case Usage::depth:
        return GL_FRAMEBUFFER_BARRIER_BIT;
    case Usage::indirect:
        return GL_COMMAND_BARRIER_BIT;
    }
    return 0;
}

static bool stores(const PlanSlot& slot) {
    return slot.use.writes && (slot.use.usage == Usage::image || slot.use.usage == Usage::storage);
}

/// Shader stores (image, storage) are incoherent: whoever uses the resource next needs a barrier for its own way of
/// access, and a store to what a shader read before needs one that makes it wait for those reads. Framebuffer writes
/// and clears are ordered by OpenGL itself, and a frame ends with a barrier for everything.
void place_barriers(Plan& plan) {
    std::map<int, GLbitfield> pending;        // resource → ways of access that still await a barrier
    std::map<GLbitfield, std::set<int>> read; // way of storing → resources read since the last barrier of that kind
    const GLbitfield all = GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                           GL_SHADER_STORAGE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_COMMAND_BARRIER_BIT;
    const GLbitfield ways[] = {GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, GL_SHADER_STORAGE_BARRIER_BIT};
    for (PlanPass& pass : plan.passes) {
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource < 0 || slot.bind.previous) continue;
            GLbitfield own = barrier_for(slot.use.usage);
            pass.barriers |= pending[slot.resource] & own;
            if (stores(slot) && read[own].contains(slot.resource)) pass.barriers |= own;
        }
        for (auto& [resource, bits] : pending)
            bits &= ~pass.barriers;
        for (GLbitfield way : ways)
            if (pass.barriers & way) read[way].clear();
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource < 0 || slot.bind.previous) continue;
            bool by_shader = slot.use.usage != Usage::colour && slot.use.usage != Usage::depth;
            if (slot.use.reads && by_shader)
                for (GLbitfield way : ways)
                    read[way].insert(slot.resource);
            if (!stores(slot)) continue;
            pending[slot.resource] = all;
            for (const PlanSlot& other : pass.slots)
                if (other.resource == slot.resource) pass.step_barriers |= barrier_for(other.use.usage);
        }
    }
}

} // namespace bounce
