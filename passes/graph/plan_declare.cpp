// The first phase of a plan: every pass declares what it reads and writes, and the resources are joined with the
// file's.
#include "graph/declared.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

/// The fields that the file gives to a resource.
static bool is_given(const PlanDraft& draft, const std::string& resource, const char* field) {
    const auto& all = draft.model.file().set_fields;
    auto fields = all.find(resource);
    return fields != all.end() &&
           std::find(fields->second.begin(), fields->second.end(), field) != fields->second.end();
}

/// The file changes what it names and leaves the rest as the pass has it.
static ResourceDeclaration merged(const PlanDraft& draft, ResourceDeclaration made, const ResourceDeclaration& file) {
    auto given = [&](const char* field) { return is_given(draft, file.name, field); };
    if (given("kind")) made.kind = file.kind;
    if (given("format")) made.format = file.format;
    if (given("size")) made.size = file.size;
    if (given("mips")) made.mips = file.mips;
    if (given("count")) made.count = file.count;
    if (given("stride")) made.stride = file.stride;
    if (given("persistent")) made.persistent = file.persistent;
    if (given("clear")) made.overwritten = file.overwritten;
    if (given("radiance")) made.radiance = file.radiance;
    if (given("neutral")) made.neutral = file.neutral;
    return made;
}

static void take_resource(PlanDraft& draft, const PassNode& node, ResourceDeclaration made, ErrorList& errors) {
    BindEntry target = node.target_of(made.name);
    bool rebound = target.resource != made.name || node.entry.bind.contains(made.name);
    made.name = target.resource;
    made.declared_by = node.id();
    ResourceDeclaration* known = draft.find(made.name);
    if (!known)
        draft.resources.push_back(std::move(made));
    else if (known->declared_by == "graph file")
        *known = merged(draft, std::move(made), *known);
    else if (!rebound && known->declared_by != node.id())
        errors.add(fmt::format("passes '{}' and '{}' both make '{}'; bind one of them to another name",
                               known->declared_by, node.id(), made.name));
}

static void declare_pass(PlanDraft& draft, const PassNode& node, ErrorList& errors) {
    auto slots_of = [&](const std::string& name) {
        Program* program = node.program(name);
        if (!program) throw Error("pass '" + node.id() + "' has no program '" + name + "'");
        return program->slots();
    };
    Declaration declaration(draft.facts, draft.size, slots_of);
    Declared pass;
    pass.node = &node;
    pass.skipped = node.enabled ? node.pass->skip_reason(draft.facts) : "switched off";
    try {
        node.pass->declare(declaration);
    } catch (const Error& error) {
        errors.add("pass '" + node.id() + "': " + error.what());
    }
    pass.uses = declaration.slot_uses();
    pass.programs = declaration.programs();
    pass.counters = declaration.counters();
    pass.repeat_from = declaration.repeat_from;
    pass.repeat_to = declaration.repeat_to;
    pass.loop = declaration.loop;
    pass.facts_read = declaration.facts_read();
    pass.picture_size_read = declaration.picture_size_read();
    for (SlotUse& use : pass.uses) {
        if (use.where.empty()) use.where = "pass '" + node.id() + "'";
        pass.targets.push_back(node.target_of(use.slot));
    }
    for (const ResourceDeclaration& made : declaration.resources())
        take_resource(draft, node, made, errors);
    draft.passes.push_back(std::move(pass));
}

/// What a writer's slot says that its resource holds where nothing is written, unless the file or C++ say otherwise.
static void take_neutrals(PlanDraft& draft) {
    for (const Declared& pass : draft.passes) {
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            if (!pass.uses[i].writes || !pass.uses[i].neutral) continue;
            ResourceDeclaration* resource = draft.find(pass.targets[i].resource);
            if (!resource || resource->neutral != glm::vec4(0) || is_given(draft, resource->name, "neutral")) continue;
            resource->neutral = *pass.uses[i].neutral;
        }
    }
}

void declare_passes(PlanDraft& draft, ErrorList& errors) {
    draft.resources = draft.model.file().resources;
    for (const auto& node : draft.model.nodes())
        declare_pass(draft, *node, errors);
    take_neutrals(draft);
}

} // namespace bounce
