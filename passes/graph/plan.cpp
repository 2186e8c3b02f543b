#include "graph/plan.h"

#include "graph/declared.h"

#include <algorithm>
#include <map>
#include <set>

namespace bounce {

namespace {

/// The last phase: names become indices of resources.
class PlanFiller {
  public:
    PlanFiller(const PlanDraft& draft, PlanSizes& sizes) : draft_(draft), sizes_(sizes) { plan_.size = draft.size; }

    Plan run(const std::vector<int>& order) {
        for (const Declared& pass : draft_.passes)
            if (!pass.skipped.empty()) plan_.skipped.push_back({pass.node->id(), pass.skipped});
        for (const ResourceDeclaration& resource : draft_.resources) {
            auto is_written = [&](int p) {
                const Declared& pass = draft_.passes[size_t(p)];
                for (size_t i = 0; i < pass.uses.size(); ++i)
                    if (pass.uses[i].writes && pass.targets[i].resource == resource.name) return true;
                return false;
            };
            // What nobody writes takes no memory: its readers get the neutral value.
            if (std::none_of(order.begin(), order.end(), is_written)) continue;
            index_[resource.name] = int(plan_.resources.size());
            plan_.resources.push_back(sizes_.of(resource.name));
        }
        for (int p : order)
            add_pass(draft_.passes[size_t(p)]);
        return std::move(plan_);
    }

  private:
    void add_pass(const Declared& declared) {
        PlanPass pass;
        const auto& nodes = draft_.model.nodes();
        pass.node = int(std::find_if(nodes.begin(), nodes.end(), [&](auto& n) { return n.get() == declared.node; }) -
                        nodes.begin());
        pass.id = declared.node->id();
        pass.programs = declared.programs;
        pass.repeat_from = declared.repeat_from;
        pass.repeat_to = declared.repeat_to;
        pass.loop = declared.loop;
        pass.facts_read = declared.facts_read;
        pass.picture_size_read = declared.picture_size_read;
        for (size_t i = 0; i < declared.uses.size(); ++i)
            add_slot(pass, declared.uses[i], declared.targets[i]);
        for (const CounterDeclaration& counter : declared.counters) {
            auto found = index_.find(counter.buffer);
            if (found != index_.end())
                pass.counters.push_back({counter.label, found->second, counter.element, counter.overflow});
        }
        plan_.passes.push_back(std::move(pass));
    }

    void add_slot(PlanPass& pass, const SlotUse& use, const BindEntry& target) {
        PlanSlot slot{use, -1, is_builtin(use.slot), glm::vec4(0), target, plan_.size};
        if (const ResourceDeclaration* known = draft_.find(target.resource)) {
            slot.neutral = known->neutral;
            slot.neutral_size = glm::ivec2(sizes_.of(known->name).texture.size);
        }
        if (use.neutral) slot.neutral = *use.neutral;
        auto found = index_.find(target.resource);
        if (!slot.builtin && found != index_.end()) {
            slot.resource = found->second;
            PlanResource& resource = plan_.resources[size_t(slot.resource)];
            if (target.previous) resource.needs_previous = true;
            auto add = [&](std::vector<std::string>& ids) {
                if (std::find(ids.begin(), ids.end(), pass.id) == ids.end()) ids.push_back(pass.id);
            };
            if (use.writes) add(resource.writers);
            if (use.reads) add(resource.readers);
            const ResourceDeclaration& of = resource.declaration;
            bool kept = of.persistent || of.incremental || of.overwritten;
            if (use.writes && written_.insert(slot.resource).second && !kept) pass.clears.push_back(slot.resource);
        }
        pass.slots.push_back(std::move(slot));
    }

    const PlanDraft& draft_;
    PlanSizes& sizes_;
    Plan plan_;
    std::map<std::string, int> index_; ///< resource → index into the plan's
    std::set<int> written_;            ///< by the passes so far
};

} // namespace

ResourceDeclaration* PlanDraft::find(const std::string& name) {
    auto found = std::find_if(resources.begin(), resources.end(), [&](auto& r) { return r.name == name; });
    return found == resources.end() ? nullptr : &*found;
}

const ResourceDeclaration* PlanDraft::find(const std::string& name) const {
    return const_cast<PlanDraft*>(this)->find(name);
}

bool PlanDraft::has_writer(const std::string& resource) const {
    for (const Declared& pass : passes) {
        for (size_t i = 0; i < pass.uses.size(); ++i)
            if (pass.uses[i].writes && pass.targets[i].resource == resource) return true;
    }
    return false;
}

bool PlanDraft::all_writers_skipped(const std::string& resource) const {
    bool any = false;
    for (const Declared& pass : passes) {
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            if (!pass.uses[i].writes || pass.targets[i].resource != resource) continue;
            if (pass.skipped.empty()) return false;
            any = true;
        }
    }
    return any;
}

/// While it lives, the model notes which parameters expressions take their values from.
struct NotedNumbers {
    explicit NotedNumbers(const GraphModel& of) : model(of) { model.note_numbers(true); }
    ~NotedNumbers() { model.note_numbers(false); }
    const GraphModel& model;
};

Plan GraphModel::plan(const SceneFacts& facts, glm::ivec2 size) const {
    NotedNumbers noted(*this);
    ErrorList errors;
    auto end_phase = [&] { errors.throw_if_any("graph '" + file_.name + "'"); };
    PlanDraft draft{*this, facts, size, {}, {}};
    declare_passes(draft, errors);
    end_phase();
    check_sources(draft, errors);
    end_phase();
    PlanSizes sizes(draft, errors);
    for (const ResourceDeclaration& resource : draft.resources)
        sizes.of(resource.name);
    skip_passes(draft, sizes, errors);
    resolve_repeats(draft, sizes, errors);
    end_phase();
    std::vector<int> order = order_passes(draft, errors);
    end_phase();
    Plan plan = PlanFiller(draft, sizes).run(order);
    place_barriers(plan);
    check_plan(*this, facts, plan, errors);
    end_phase();
    plan.numbers = note_numbers(false);
    return plan;
}

} // namespace bounce
