#include "app/experiments/ablation.h"

#include "core/error.h"
#include "graph/graph_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace bounce {

namespace {

/// The passes that what is made in the end stands on, themselves among it.
std::set<std::string> passes_behind(const Plan& plan, const std::vector<std::string>& resources) {
    std::set<std::string> passes;
    std::vector<std::string> open = resources;
    while (!open.empty()) {
        const PlanResource* resource = plan.find_resource(open.back());
        open.pop_back();
        if (!resource) continue;
        for (const std::string& writer : resource->writers) {
            if (!passes.insert(writer).second) continue;
            const auto pass =
                std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlanPass& p) { return p.id == writer; });
            for (const PlanSlot& slot : pass->slots)
                if (slot.resource >= 0) open.push_back(plan.resources[size_t(slot.resource)].name());
        }
    }
    return passes;
}

void join_variants(Variant& into, const Variant& other) {
    into.sets.insert(other.sets.begin(), other.sets.end());
    into.switches.insert(other.switches.begin(), other.switches.end());
}

/// Measures a part, or tells why it cannot be left out.
void measure_part(VariantMeasurer& measurer, const VariantFigures& whole, AblatedPart& part) {
    try {
        part.figures = measurer.measure(part.without);
    } catch (const Error& error) {
        part.failed = error.what();
        return;
    }
    part.time_change = part.figures.ms / whole.ms - 1;
    part.bytes_change = double(part.figures.bytes) / double(whole.bytes) - 1;
    part.error_change = part.figures.error - whole.error;
    part.flicker_change = part.figures.flicker - whole.flicker;
    part.uncertainty = std::hypot(part.figures.error_spread, whole.error_spread);
}

/// Whether the error grows by less, of itself, than the time shrinks, of itself, times `worth`.
bool is_worth_dropping(const VariantFigures& before, const VariantFigures& after, double worth) {
    const double saved = 1 - after.ms / before.ms;
    return saved > 0 && after.error - before.error < worth * saved * before.error;
}

/// Drops what buys least for its time, one after the other, as long as that is less than it has to buy.
void find_minimal(VariantMeasurer& measurer, const AblationSettings& settings, Ablation& ablation,
                  const std::function<void(const std::string&)>& say) {
    ablation.minimal_figures = ablation.whole;
    std::vector<const AblatedPart*> candidates;
    for (const AblatedPart& part : ablation.parts)
        if (part.failed.empty() && is_worth_dropping(ablation.whole, part.figures, settings.worth))
            candidates.push_back(&part);
    std::sort(candidates.begin(), candidates.end(), [](const AblatedPart* a, const AblatedPart* b) {
        return a->error_change - a->time_change * 1e-3 < b->error_change - b->time_change * 1e-3;
    });
    for (const AblatedPart* part : candidates) {
        Variant next = ablation.minimal;
        join_variants(next, part->without);
        try {
            const VariantFigures figures = measurer.measure(next);
            if (!is_worth_dropping(ablation.minimal_figures, figures, settings.worth)) continue;
            say(fmt::format("minimal graph: without {}: {:.3g} ms, error {:.2f} %", part->name, figures.ms,
                            100 * figures.error));
            ablation.minimal = next;
            ablation.minimal_figures = figures;
            ablation.dropped.push_back(part->name);
        } catch (const Error& error) {
            say(fmt::format("minimal graph: {} cannot go with the others: {}", part->name, error.what()));
        }
    }
}

} // namespace

std::string published_graph_of(const std::string& graph) {
    const GraphFile file = read_graph_file(find_graph(graph));
    if (file.files.size() < 2 || file.files[1].parent_path().filename() == "base") return "";
    return file.files[1].string();
}

std::vector<AblatedPart> parts_to_leave_out(const GraphModel& graph, const GraphModel* published, const Plan& plan) {
    std::vector<AblatedPart> parts;
    const std::set<std::string> compared = passes_behind(plan, graph.file().transport.parts);
    const std::set<std::string> shown = passes_behind(plan, {"out.display", "out.radiance"});
    for (const PlanPass& pass : plan.passes) {
        // What only shows the picture, tone mapping for one, is no part of the method.
        if (shown.contains(pass.id) && !compared.contains(pass.id)) continue;
        AblatedPart part;
        part.name = pass.id + " off";
        part.without.switches[pass.id] = false;
        parts.push_back(part);
    }
    if (!published) return parts;
    for (const auto& node : graph.nodes()) {
        const PassNode* other = published->find_node(node->id());
        if (!other || !node->enabled) continue;
        if (!std::any_of(plan.passes.begin(), plan.passes.end(), [&](auto& p) { return p.id == node->id(); })) continue;
        for (const Parameter& p : node->parameters.all()) {
            const Parameter* theirs = published->find_parameter(node->id() + "." + p.info.name);
            if (!theirs || theirs->info.kind != p.info.kind) continue;
            const std::string own = to_text(p.info, p.value), text = to_text(theirs->info, theirs->value);
            if (own == text) continue;
            AblatedPart part;
            const std::string name = node->id() + "." + p.info.name;
            part.name = fmt::format("{}: {} → {}", name, own, text);
            part.without.sets[name] = text;
            parts.push_back(part);
        }
    }
    return parts;
}

Ablation ablate(VariantMeasurer& measurer, const AblationSettings& settings,
                const std::function<void(const std::string&)>& say) {
    Ablation ablation;
    const GraphModel& model = measurer.session().graph().model();
    std::optional<GraphModel> published;
    if (!settings.published.empty()) published.emplace(read_graph_file(find_graph(settings.published)));
    ablation.whole = measurer.measure({});
    say(fmt::format("the whole graph: {:.3g} ms, error {:.2f} %", ablation.whole.ms, 100 * ablation.whole.error));
    if (!(ablation.whole.ms > 0)) throw Error("the graph's time could not be measured");
    ablation.parts = parts_to_leave_out(model, published ? &*published : nullptr, measurer.session().graph().plan());
    for (AblatedPart& part : ablation.parts) {
        measure_part(measurer, ablation.whole, part);
        say(part.failed.empty() ? fmt::format("without {}: time {:+.1f} %, error {:+.2f} points", part.name,
                                              100 * part.time_change, 100 * part.error_change)
                                : fmt::format("without {}: not measured: {}", part.name, part.failed));
    }
    std::stable_sort(ablation.parts.begin(), ablation.parts.end(), [](const AblatedPart& a, const AblatedPart& b) {
        return a.failed.empty() != b.failed.empty() ? a.failed.empty() : a.error_change > b.error_change;
    });

    std::vector<const AblatedPart*> strongest;
    for (const AblatedPart& part : ablation.parts)
        if (part.failed.empty() && int(strongest.size()) < settings.pairs_of) strongest.push_back(&part);
    for (size_t i = 0; i < strongest.size(); ++i)
        for (size_t k = i + 1; k < strongest.size(); ++k) {
            AblatedPart pair;
            pair.name = strongest[i]->name + ", " + strongest[k]->name;
            pair.without = strongest[i]->without;
            join_variants(pair.without, strongest[k]->without);
            measure_part(measurer, ablation.whole, pair);
            if (!pair.failed.empty()) continue;
            say(fmt::format("without {}: error {:+.2f} points", pair.name, 100 * pair.error_change));
            ablation.pairs.push_back(std::move(pair));
        }
    find_minimal(measurer, settings, ablation, say);
    measurer.use(ablation.minimal);
    return ablation;
}

} // namespace bounce
