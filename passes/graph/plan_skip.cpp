// Which passes do not run, and why: what is switched off, what the scene does not need, what all comes from such
// passes, and what only such passes read.
#include "graph/declared.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace bounce {

static void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// "lights && glossy_materials" → "requires lights and glossy materials".
static std::string requirement_text(std::string needs) {
    replace_all(needs, "&&", "and");
    replace_all(needs, "||", "or");
    for (const std::string& fact : scene_fact_names()) {
        std::string words = fact;
        std::replace(words.begin(), words.end(), '_', ' ');
        auto is_name = [&](size_t i) {
            return i < needs.size() &&
                   (std::isalnum(static_cast<unsigned char>(needs[i])) || needs[i] == '_' || needs[i] == '.');
        };
        for (size_t at = needs.find(fact); at != std::string::npos; at = needs.find(fact, at + fact.size()))
            if (!is_name(at - 1) && !is_name(at + fact.size())) needs.replace(at, fact.size(), words);
    }
    return "requires " + needs;
}

static void judge_needs(Declared& pass, const PlanSizes& sizes, ErrorList& errors) {
    const std::string& needs = pass.node->entry.needs;
    if (!pass.skipped.empty() || needs.empty()) return;
    try {
        if (evaluate(needs, sizes.names()) == 0) pass.skipped = requirement_text(needs);
    } catch (const Error& error) {
        errors.add(fmt::format("pass '{}': 'needs': {}", pass.node->id(), error.what()));
    }
}

/// Readers of what a pass that does not run would have made get what it names instead.
static void use_fallbacks(PlanDraft& draft) {
    for (const Declared& gone : draft.passes) {
        if (gone.skipped.empty()) continue;
        for (const auto& [made, instead] : gone.node->pass->fallbacks()) {
            std::string from = gone.node->target_of(made).resource, to = gone.node->target_of(instead).resource;
            for (Declared& pass : draft.passes) {
                for (size_t i = 0; i < pass.uses.size(); ++i)
                    if (!pass.uses[i].writes && pass.targets[i].resource == from) pass.targets[i].resource = to;
            }
        }
    }
}

static bool makes_the_picture(const Declared& pass) {
    return std::any_of(pass.targets.begin(), pass.targets.end(),
                       [](auto& t) { return t.resource == "out.radiance" || t.resource == "out.display"; });
}

/// Everything that this pass reads from the graph comes from skipped passes.
static bool is_starved(const PlanDraft& draft, const Declared& pass) {
    bool any = false;
    for (size_t i = 0; i < pass.uses.size(); ++i) {
        const SlotUse& use = pass.uses[i];
        if (!use.reads || use.writes || is_builtin(use.slot) || pass.targets[i].previous) continue;
        if (use.optional && !draft.has_writer(pass.targets[i].resource)) continue;
        if (!draft.all_writers_skipped(pass.targets[i].resource)) return false;
        any = true;
    }
    return any;
}

static bool skip_starved(PlanDraft& draft) {
    bool changed = false;
    for (Declared& pass : draft.passes) {
        if (!pass.skipped.empty() || makes_the_picture(pass) || !is_starved(draft, pass)) continue;
        pass.skipped = "all that it reads comes from skipped passes";
        changed = true;
    }
    return changed;
}

/// Whether `reader` reads something that `writer` writes.
static bool reads_from(const Declared& reader, const Declared& writer) {
    for (size_t i = 0; i < writer.uses.size(); ++i) {
        if (!writer.uses[i].writes) continue;
        for (size_t j = 0; j < reader.uses.size(); ++j)
            if (reader.uses[j].reads && reader.targets[j].resource == writer.targets[i].resource) return true;
    }
    return false;
}

/// Whether a pass runs whoever reads it: it makes an output or what somebody asked for, or nothing of the graph ever
/// reads it (somebody looks at it), or the file has it off and a person switched it on.
static bool is_wanted(const PlanDraft& draft, const Declared& pass) {
    if (!pass.node->entry.enabled) return true;
    for (size_t i = 0; i < pass.uses.size(); ++i) {
        const std::string& resource = pass.targets[i].resource;
        if (pass.uses[i].writes && (resource.starts_with("out.") || draft.model.is_asked_for(resource))) return true;
    }
    return std::none_of(draft.passes.begin(), draft.passes.end(),
                        [&](const Declared& other) { return &other != &pass && reads_from(other, pass); });
}

/// The passes that run and that no wanted pass reads, directly or through others.
static std::vector<Declared*> unread_passes(PlanDraft& draft) {
    std::vector<Declared*> rest;
    std::vector<const Declared*> open; // wanted ones whose sources are not found yet
    for (Declared& pass : draft.passes) {
        if (!pass.skipped.empty()) continue;
        if (is_wanted(draft, pass))
            open.push_back(&pass);
        else
            rest.push_back(&pass);
    }
    while (!open.empty()) {
        const Declared& reader = *open.back();
        open.pop_back();
        auto unread = std::partition(rest.begin(), rest.end(), [&](auto* pass) { return reads_from(reader, *pass); });
        open.insert(open.end(), rest.begin(), unread);
        rest.erase(rest.begin(), unread);
    }
    return rest;
}

/// Skips those of them that skipped passes read, directly or through others: also where they feed one another.
static bool skip_unread(PlanDraft& draft) {
    std::vector<Declared*> rest = unread_passes(draft);
    bool any = false;
    for (bool changed = true; changed;) {
        changed = false;
        for (Declared* pass : rest) {
            auto is_gone = [&](const Declared& reader) { return !reader.skipped.empty() && reads_from(reader, *pass); };
            if (!pass->skipped.empty() || std::none_of(draft.passes.begin(), draft.passes.end(), is_gone)) continue;
            pass->skipped = "only skipped passes read what it makes";
            any = changed = true;
        }
    }
    return any;
}

void skip_passes(PlanDraft& draft, PlanSizes& sizes, ErrorList& errors) {
    for (Declared& pass : draft.passes)
        judge_needs(pass, sizes, errors);
    use_fallbacks(draft);
    while (skip_starved(draft) || skip_unread(draft)) {
    }
}

} // namespace bounce
