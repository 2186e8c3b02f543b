#include "graph/script_pass.h"

#include "core/error.h"
#include "graph/context.h"

#include <fmt/format.h>

namespace bounce {

void ScriptPass::describe(PassDescription& description) {
    description.program("main", {entry_.shader});
}

void ScriptPass::declare(Declaration& declaration) {
    declaration.uses("main");
    if (!entry_.dispatch.indirect.empty()) declaration.reads(entry_.dispatch.indirect, Usage::indirect);
}

void ScriptPass::execute(PassContext& context) {
    const DispatchEntry& dispatch = entry_.dispatch;
    if (!dispatch.indirect.empty()) {
        context.dispatch_indirect("main", dispatch.indirect);
        return;
    }
    glm::ivec3 threads(1);
    if (!dispatch.threads.empty()) {
        for (size_t i = 0; i < dispatch.threads.size(); ++i)
            threads[int(i)] = context.integer(dispatch.threads[i]);
    } else {
        // One thread a texel of the named resource, or of the first texture that the shader writes.
        const PlanSlot* over = nullptr;
        for (const PlanSlot& slot : context.plan().slots) {
            bool named = slot.bind.resource == dispatch.resource || slot.use.slot == dispatch.resource;
            bool texture = slot.use.usage != Usage::storage && slot.use.usage != Usage::indirect;
            if (!over && texture && slot.resource >= 0 && (dispatch.resource.empty() ? slot.use.writes : named))
                over = &slot;
            // Prefer the slot that is written: it may be bound to another mip than the one that is read.
            if (over && named && texture && slot.use.writes && !over->use.writes) over = &slot;
        }
        auto side = [&](const char* name) { return context.number(dispatch.resource + "." + name); };
        if (!over && side("width")) { // a texture that is no slot of this pass
            context.dispatch("main", {int(*side("width")), int(*side("height")), int(*side("depth"))});
            return;
        }
        if (!over)
            throw Error(fmt::format("pass '{}' has nothing to dispatch over: give \"dispatch\": [x, y, z]", entry_.id));
        threads = context.size(over->use.slot);
    }
    context.dispatch("main", threads);
}

BOUNCE_REGISTER_PASS("compute", ScriptPass, "a compute shader: a .comp file, its resources and a dispatch size; no C++")

} // namespace bounce
