// Whether what the passes read has a source, and what the file binds is a slot.
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

bool is_builtin(const std::string& slot) {
    return slot.starts_with("scene.") || slot.starts_with("material.");
}

/// Whether the pass's parameters make it need what is optional otherwise.
static bool is_required(const PlanDraft& draft, const Declared& pass, const SlotUse& use, ErrorList& errors) {
    if (use.required_if.empty()) return false;
    auto full = [&pass](const std::string& name) { return pass.node->id() + "." + name; };
    Names names([&](const std::string& name) { return draft.model.number(full(name)); });
    names.choices = [&](const std::string& name) { return draft.model.choices(full(name)); };
    names.known = [&] { return pass.node->parameters.names(); };
    try {
        return evaluate(use.required_if, names) != 0;
    } catch (const Error& error) {
        errors.add(fmt::format("pass '{}' ({}): {}", pass.node->id(), use.where, error.what()));
        return false;
    }
}

/// Whether the node's shaders cannot be read for the moment, so that their slots are not known.
static bool is_broken(const PassNode& node) {
    return std::any_of(node.programs.begin(), node.programs.end(), [](auto& p) { return !p->errors().empty(); });
}

static void check_bound_slots(const Declared& pass, ErrorList& errors) {
    const PassNode& node = *pass.node;
    if (is_broken(node)) return;
    for (const auto& [slot, bind] : node.entry.bind) {
        std::vector<std::string> names;
        for (const SlotUse& use : pass.uses)
            names.push_back(use.slot);
        // Slots of programs that are not needed at these parameters may be bound all the same.
        for (const auto& program : node.programs)
            for (const ShaderSlot& of : program->slots())
                names.push_back(of.name);
        if (std::find(names.begin(), names.end(), slot) == names.end())
            errors.add(fmt::format("pass '{}' has no slot '{}'{}", node.id(), slot, did_you_mean(slot, names)));
    }
}

void check_sources(const PlanDraft& draft, ErrorList& errors) {
    std::vector<std::string> names;
    for (const ResourceDeclaration& resource : draft.resources)
        names.push_back(resource.name);
    for (const Declared& pass : draft.passes) {
        check_bound_slots(pass, errors);
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            const SlotUse& use = pass.uses[i];
            const std::string& target = pass.targets[i].resource;
            if (is_builtin(use.slot)) continue;
            if (use.optional && (draft.has_writer(target) || !is_required(draft, pass, use, errors))) continue;
            std::string when = use.optional ? " with " + use.required_if : "";
            std::string slot =
                use.slot == target ? "'" + target + "'" : fmt::format("'{}' (slot {})", target, use.slot);
            const ResourceDeclaration* resource = draft.find(target);
            bool is_read = use.reads && !use.writes && !pass.targets[i].previous;
            bool buffer = resource && resource->kind == ResourceKind::buffer;
            std::string problem;
            if (!resource) {
                problem = fmt::format("{} {}{}, which nothing declares{}", use.writes ? "writes" : "reads", slot, when,
                                      did_you_mean(target, names));
            } else if (is_read && !draft.has_writer(target)) {
                problem = fmt::format("reads {}{}, which nothing writes", slot, when);
            } else if (buffer != (use.usage == Usage::storage || use.usage == Usage::indirect)) {
                problem = fmt::format("uses {} as a {}, but it is a {}", slot, buffer ? "texture" : "buffer",
                                      to_string(resource->kind));
            } else {
                continue;
            }
            errors.add(fmt::format("pass '{}' ({}) {}", pass.node->id(), use.where, problem));
        }
    }
}

} // namespace bounce
