#include "app/debug_views.h"

#include "core/error.h"
#include "core/image.h"
#include "core/paths.h"
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>

namespace bounce {

std::string shader_about(const std::string& text) {
    std::string about;
    for (const std::string& line : split(text, '\n')) {
        if (!line.starts_with("//")) break;
        const size_t from = line.find_first_not_of("/ ");
        if (from == std::string::npos) break;
        about += (about.empty() ? "" : " ") + line.substr(from);
    }
    return about;
}

static std::string about_of(const PassNode& node) {
    const auto& programs = node.description->programs;
    if (programs.empty() || programs.front().stages.empty()) return {};
    try {
        return shader_about(read_file(glsl_folder() / programs.front().stages.back()));
    } catch (const Error&) {
        return {}; // told by the shader's own row
    }
}

std::vector<DebugView> debug_views(const GraphModel& model, const SceneFacts& facts, glm::ivec2 size) {
    PlanDraft draft{model, facts, size, {}, {}};
    ErrorList ignored; // told when it was planned
    declare_passes(draft, ignored);
    const auto each_use = [&](auto visit) {
        for (const Declared& pass : draft.passes)
            for (size_t i = 0; i < pass.uses.size(); ++i)
                visit(pass, pass.uses[i], pass.targets[i].resource);
    };
    std::vector<DebugView> views;
    each_use([&](const Declared& pass, const SlotUse& use, const std::string& resource) {
        const ResourceDeclaration* declared = draft.find(resource);
        if (!use.writes || !resource.starts_with("debug.") || !declared || declared->kind == ResourceKind::buffer)
            return;
        bool feeds =
            std::any_of(views.begin(), views.end(), [&](const DebugView& v) { return v.resource == resource; });
        each_use([&](const Declared& reader, const SlotUse& read, const std::string& name) {
            feeds = feeds || (name == resource && read.reads && reader.node != pass.node);
        });
        if (feeds) return;
        std::string name = resource.substr(6);
        std::replace(name.begin(), name.end(), '_', ' ');
        views.push_back({pass.node->id(), resource, name, about_of(*pass.node)});
    });
    return views;
}

} // namespace bounce
