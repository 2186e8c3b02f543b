// Whether what the passes read has a source.
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

bool is_builtin(const std::string& slot) {
    return slot.starts_with("scene.") || slot.starts_with("material.");
}

bool has_writer(const std::vector<Declared>& passes, const std::string& resource) {
    for (const Declared& pass : passes) {
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            if (pass.uses[i].writes && pass.targets[i].resource == resource) return true;
        }
    }
    return false;
}

static const ResourceDeclaration* find(const std::vector<ResourceDeclaration>& resources, const std::string& name) {
    auto found = std::find_if(resources.begin(), resources.end(), [&](auto& r) { return r.name == name; });
    return found == resources.end() ? nullptr : &*found;
}

void check_sources(std::vector<Declared>& passes, const std::vector<ResourceDeclaration>& resources, bool incomplete,
                   ErrorList& errors) {
    std::vector<std::string> names;
    for (const ResourceDeclaration& resource : resources)
        names.push_back(resource.name);
    for (Declared& pass : passes) {
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            const SlotUse& use = pass.uses[i];
            const std::string& target = pass.targets[i].resource;
            if (is_builtin(use.slot) || use.optional) continue;
            std::string slot =
                use.slot == target ? "'" + target + "'" : fmt::format("'{}' (slot {})", target, use.slot);
            const ResourceDeclaration* resource = find(resources, target);
            bool is_read = use.reads && !use.writes && !pass.targets[i].previous;
            bool buffer = resource && resource->kind == ResourceKind::buffer;
            std::string problem;
            if (!resource) {
                problem = fmt::format("{} {}, which nothing declares{}", use.writes ? "writes" : "reads", slot,
                                      did_you_mean(target, names));
            } else if (is_read && !has_writer(passes, target)) {
                problem = fmt::format("reads {}, which nothing writes", slot);
            } else if (buffer != (use.usage == Usage::storage || use.usage == Usage::indirect)) {
                problem = fmt::format("uses {} as a {}, but it is a {}", slot, buffer ? "texture" : "buffer",
                                      to_string(resource->kind));
            } else {
                continue;
            }
            pass.faulty = true;
            bool has_source = resource && (!is_read || has_writer(passes, target));
            if (pass.node->entry.doubtful || (incomplete && !has_source)) continue;
            errors.add(fmt::format("pass '{}' ({}) {}", pass.node->id(), use.where, problem));
        }
    }
}

} // namespace bounce
