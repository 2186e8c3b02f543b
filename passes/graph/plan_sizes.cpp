// Sizes of resources, and steps of repeated passes.
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

PlanSizes::PlanSizes(PlanDraft& draft, ErrorList& errors)
    : draft_(draft), errors_(errors), scope_{draft.model, &draft.facts, draft.size, {}, {}, {}} {
    scope_.resource = [this](const std::string& name) { return draft_.find(name) ? &of(name) : nullptr; };
    scope_.resource_names = [this] {
        std::vector<std::string> names;
        for (const ResourceDeclaration& resource : draft_.resources)
            names.push_back(resource.name);
        return names;
    };
}

static void evaluate_size(PlanResource& resource, const Names& names) {
    const ResourceDeclaration& declaration = resource.declaration;
    if (declaration.kind == ResourceKind::buffer) {
        resource.count = uint64_t(evaluate_integer(declaration.count, names, 0));
        resource.bytes = resource.count * uint64_t(declaration.stride);
        return;
    }
    TextureDesc& desc = resource.texture;
    desc.kind = declaration.kind == ResourceKind::texture_2d         ? TextureKind::texture_2d
                : declaration.kind == ResourceKind::texture_2d_array ? TextureKind::texture_2d_array
                                                                     : TextureKind::texture_3d;
    desc.format = format_by_name(declaration.format).internal;
    for (int i = 0; i < 3; ++i)
        desc.size[i] = evaluate_integer(declaration.size.parts[size_t(i)], names, 1);
    int full = full_mip_count(desc);
    desc.mips = declaration.mips == "full" ? full : std::min(full, evaluate_integer(declaration.mips, names, 1));
    resource.bytes = texture_bytes(desc);
}

const PlanResource& PlanSizes::of(const std::string& name) {
    if (auto known = sized_.find(name); known != sized_.end()) return known->second;
    PlanResource resource;
    resource.declaration = *draft_.find(name);
    if (!sizing_.insert(name).second) throw Error("the size of '" + name + "' depends on itself");
    try {
        evaluate_size(resource, names());
    } catch (const Error& error) {
        errors_.add(
            fmt::format("resource '{}' (declared by {}): {}", name, resource.declaration.declared_by, error.what()));
    }
    sizing_.erase(name);
    return sized_[name] = std::move(resource);
}

/// Takes the steps of the pass that declares the loop.
static void join_loop(const PlanDraft& draft, Declared& pass) {
    std::vector<std::string> loops;
    for (const Declared& other : draft.passes) {
        if (other.loop.empty() || other.node->entry.repeat.over == "loop") continue;
        if (other.loop == pass.loop) {
            pass.repeat_from = other.repeat_from, pass.repeat_to = other.repeat_to;
            return;
        }
        loops.push_back(other.loop);
    }
    throw Error(
        fmt::format("no pass says what the steps of the loop '{}' are{}", pass.loop, did_you_mean(pass.loop, loops)));
}

static void resolve_repeat(const PlanDraft& draft, Declared& pass, PlanSizes& sizes) {
    const RepeatEntry& repeat = pass.node->entry.repeat;
    pass.loop = repeat.loop;
    if (repeat.over == "loop") return join_loop(draft, pass);
    pass.repeat_from = evaluate_integer(repeat.from, sizes.names(), 0);
    if (repeat.over == "count")
        pass.repeat_to = evaluate_integer(repeat.count, sizes.names(), 0);
    else if (repeat.over == "lights")
        pass.repeat_to = int(draft.facts.lights());
    else if (repeat.over == "views")
        pass.repeat_to = int(*sizes.number("shadow_views"));
    else if (!draft.find(repeat.of))
        throw Error("repeats over '" + repeat.of + "', which nothing declares");
    else if (repeat.over == "mips")
        pass.repeat_to = sizes.of(repeat.of).texture.mips;
    else
        pass.repeat_to = sizes.of(repeat.of).texture.size.z;
}

void resolve_repeats(PlanDraft& draft, PlanSizes& sizes, ErrorList& errors) {
    // Those that join a loop come last: its steps are known then.
    for (bool joining : {false, true}) {
        for (Declared& pass : draft.passes) {
            const std::string& over = pass.node->entry.repeat.over;
            if (over.empty() || (over == "loop") != joining) continue;
            try {
                resolve_repeat(draft, pass, sizes);
            } catch (const Error& error) {
                errors.add("pass '" + pass.node->id() + "': " + error.what());
            }
        }
    }
}

} // namespace bounce
