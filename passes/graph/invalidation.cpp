#include "graph/invalidation.h"

#include "core/digest.h"
#include "graph/graph.h"
#include "graph/own_inputs.h"

#include <algorithm>

namespace bounce {

namespace {

/// Whether it reads what earlier frames left there.
bool reads_history(const Plan& plan, const PlanSlot& slot) {
    if (slot.resource < 0 || !slot.use.reads) return false;
    return slot.bind.previous || plan.resources[size_t(slot.resource)].declaration.persistent;
}

bool writes(const PlanPass& pass, int resource) {
    return std::any_of(pass.slots.begin(), pass.slots.end(),
                       [&](const PlanSlot& slot) { return slot.resource == resource && slot.use.writes; });
}

bool keeps(const PlanResource& resource) {
    return resource.declaration.persistent || resource.declaration.incremental || resource.needs_previous;
}

} // namespace

void Invalidation::new_plan(const GraphModel& model, const Plan& plan) {
    std::erase_if(passes_, [&](const auto& known) {
        return std::none_of(plan.passes.begin(), plan.passes.end(), [&](auto& p) { return p.id == known.first; });
    });
    std::erase_if(kept_, [&](const auto& known) {
        const PlanResource* resource = plan.find_resource(known.first);
        return !resource || !keeps(*resource);
    });
    std::erase_if(lies_, [&](const auto& known) { return !plan.find_resource(known.first); });
    active_.clear();
    follows_.clear();
    for (const PlanPass& pass : plan.passes) {
        std::vector<bool>& slots = active_.emplace_back();
        for (const PlanSlot& slot : pass.slots)
            slots.push_back(slot_is_active(model, pass, slot));
        follows_.push_back(follows_camera(model, pass));
    }
    find_reach(plan);
}

/// Along what this frame makes and what earlier frames left, through as many passes as there are.
void Invalidation::find_reach(const Plan& plan) {
    size_t count = plan.passes.size();
    reach_.assign(count, std::vector<bool>(count, false));
    for (size_t i = 0; i < count; ++i) {
        reach_[i][i] = true;
        const std::vector<PlanSlot>& slots = plan.passes[i].slots;
        for (size_t k = 0; k < slots.size(); ++k) {
            const PlanSlot& slot = slots[k];
            if (slot.resource < 0 || !slot.use.reads || !active_[i][k]) continue;
            size_t last = reads_history(plan, slot) ? count : i;
            for (size_t j = 0; j < last; ++j)
                if (writes(plan.passes[j], slot.resource)) reach_[i][j] = true;
        }
    }
    for (size_t through = 0; through < count; ++through) {
        for (size_t i = 0; i < count; ++i) {
            for (size_t j = 0; reach_[i][through] && j < count; ++j)
                if (reach_[through][j]) reach_[i][j] = true;
        }
    }
}

/// What somebody changed, or the camera, in all that reaches the pass.
uint64_t Invalidation::reaching(const Plan& plan, size_t pass, Cause cause) const {
    Digest digest;
    for (size_t j = 0; j < plan.passes.size(); ++j)
        if (reach_[pass][j]) digest.add(plan.passes[j].id).add(passes_.at(plan.passes[j].id).own[cause]);
    return digest.value();
}

void Invalidation::begin_frame(const GraphModel& model, const Plan& plan, const Allocations& allocations,
                               const FrameInputs& frame, bool every_frame) {
    for (const PlanPass& pass : plan.passes) {
        PassState& state = passes_[pass.id];
        Revision now = digest_own_inputs(model, plan, pass, allocations, frame, state.inputs);
        for (int i = 0; i < k_causes; ++i) {
            uint64_t& number = state.own.by_cause[size_t(i)];
            if (!number || now.by_cause[size_t(i)] != state.seen.by_cause[size_t(i)]) number = ++serial_;
        }
        // What it looked at before somebody changed something, it may not look at now.
        if (now[Cause::lasting] != state.seen[Cause::lasting]) state.inputs = {};
        state.seen = now;
    }
    find_voids(plan);
    find_revisions(plan);
    find_runs(plan, every_frame);
}

/// A resource keeps what it holds as long as what made it is the same but for the passing of frames.
void Invalidation::find_voids(const Plan& plan) {
    voids_.clear();
    stands_.assign(plan.resources.size(), false);
    for (size_t r = 0; r < plan.resources.size(); ++r) {
        const PlanResource& resource = plan.resources[r];
        if (!keeps(resource)) continue;
        // Whoever reads history and knows where the camera was can follow its motion.
        bool follows = false;
        for (size_t i = 0; i < plan.passes.size(); ++i) {
            for (const PlanSlot& slot : plan.passes[i].slots)
                follows = follows || (follows_[i] && slot.resource == int(r) && reads_history(plan, slot));
        }
        Digest key;
        if (!resource.declaration.incremental) key.add(cuts_);
        for (size_t i = 0; i < plan.passes.size(); ++i) {
            // What only saves work is its pass's own; others may add to what lasts.
            bool makes = resource.declaration.incremental ? resource.declaration.declared_by == plan.passes[i].id
                                                          : writes(plan.passes[i], int(r));
            if (!makes) continue;
            key.add(reaching(plan, i, Cause::lasting));
            if (!follows) key.add(reaching(plan, i, Cause::camera));
        }
        Kept& kept = kept_[resource.name()];
        if (kept.key != key.value()) {
            voids_.push_back(int(r));
            kept = {key.value(), 0, 0};
        }
        stands_[r] = kept.content != 0;
    }
}

/// In the order of the plan: what a pass reads has the revision that it has at its turn.
void Invalidation::find_revisions(const Plan& plan) {
    revisions_.assign(plan.passes.size(), 0);
    contents_.assign(plan.resources.size(), 0);
    auto left_by_last_frame = [&](const PlanSlot& slot) {
        auto found = kept_.find(plan.resources[size_t(slot.resource)].name());
        if (found == kept_.end()) return uint64_t(0);
        return slot.bind.previous ? found->second.copied : found->second.content;
    };
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        const PlanPass& pass = plan.passes[i];
        PassState& state = passes_[pass.id];
        Digest revision;
        revision.add(state.own.by_cause);
        for (size_t k = 0; k < pass.slots.size(); ++k) {
            const PlanSlot& slot = pass.slots[k];
            if (slot.resource < 0 || !slot.use.reads || !active_[i][k]) continue;
            uint64_t now = contents_[size_t(slot.resource)];
            bool old = slot.bind.previous || (!now && reads_history(plan, slot));
            revision.add(slot.use.slot).add(old ? left_by_last_frame(slot) : now);
        }
        revisions_[i] = revision.value();
        // A pass adds to what those before it wrote in this frame. (Several slots may be one resource.)
        std::map<int, uint64_t> written;
        for (const PlanSlot& slot : pass.slots)
            if (slot.resource >= 0 && slot.use.writes) written[slot.resource] = contents_[size_t(slot.resource)];
        for (auto [resource, before] : written)
            contents_[size_t(resource)] = Digest().add(before).add(revisions_[i]).value();
    }
}

void Invalidation::find_runs(const Plan& plan, bool every_frame) {
    size_t count = plan.passes.size();
    runs_.assign(count, every_frame);
    for (size_t i = 0; i < count; ++i)
        runs_[i] = every_frame || passes_[plan.passes[i].id].ran != revisions_[i];
    // What is cleared is made again, even if all that it is made from is as it was.
    for (int r : voids_) {
        for (size_t i = 0; i < count; ++i)
            if (writes(plan.passes[i], r)) runs_[i] = true;
    }
    // A pass that is gone from the plan may have written on top of what those that are left made.
    for (size_t r = 0; r < plan.resources.size(); ++r) {
        const auto lies = lies_.find(plan.resources[r].name());
        if (lies == lies_.end() || lies->second == contents_[r]) continue;
        for (size_t i = 0; i < count; ++i)
            if (writes(plan.passes[i], int(r))) runs_[i] = true;
    }
    // What runs needs what it reads as it was at its turn. Where that does not lie there any more, it is made again.
    auto in_batches = [&](size_t a, size_t b) {
        const PlanPass& pass = plan.passes[a];
        return !pass.loop.empty() && pass.loop == plan.passes[b].loop && pass.repeat_to - pass.repeat_from > 1;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < count; ++i) {
            if (!runs_[i]) continue;
            for (const PlanSlot& slot : plan.passes[i].slots) {
                if (slot.resource < 0 || slot.bind.previous) continue;
                bool overwritten = false; // by itself or a pass after it, on top of what others wrote
                for (size_t j = i; j < count; ++j)
                    overwritten = overwritten || writes(plan.passes[j], slot.resource);
                for (size_t j = 0; j < count; ++j) {
                    if (runs_[j] || !writes(plan.passes[j], slot.resource)) continue;
                    // Of a structure that is built in batches only the last one lies there.
                    if (!overwritten && !(slot.use.reads && in_batches(i, j))) continue;
                    runs_[j] = true;
                    changed = true;
                }
            }
        }
    }
}

void Invalidation::ran(size_t index, const GraphModel& model, const Plan& plan, const Allocations& allocations,
                       const FrameInputs& frame, bool whole) {
    const PlanPass& pass = plan.passes[index];
    PassState& state = passes_[pass.id];
    // What it looked at for the first time is no change: what it made was made with it.
    state.seen = digest_own_inputs(model, plan, pass, allocations, frame, state.inputs);
    state.ran = revisions_[index];
    for (const PlanSlot& slot : pass.slots) {
        if (whole || slot.resource < 0 || !slot.use.writes) continue;
        auto kept = kept_.find(plan.resources[size_t(slot.resource)].name());
        if (kept != kept_.end()) kept->second.key = 0;
    }
}

void Invalidation::cut_short(const Plan& plan, size_t first, size_t last) {
    for (size_t i = first; i <= last; ++i)
        passes_[plan.passes[i].id].ran = 0;
    for (size_t r = 0; r < plan.resources.size(); ++r) {
        bool written = false, unfinished = false;
        for (size_t i = 0; i < plan.passes.size(); ++i) {
            if (!runs_[i] || !writes(plan.passes[i], int(r))) continue;
            (i <= last ? written : unfinished) = true;
        }
        if (written && unfinished) lies_[plan.resources[r].name()] = ++serial_;
    }
    // What was to be made from nothing may be half there: it is made from nothing again.
    for (size_t r = 0; r < plan.resources.size(); ++r) {
        const auto kept = kept_.find(plan.resources[r].name());
        if (kept == kept_.end() || kept->second.content) continue;
        kept->second.key = 0;
        for (const PlanPass& pass : plan.passes)
            if (writes(pass, int(r))) passes_[pass.id].ran = 0;
    }
}

std::vector<int> Invalidation::end_frame(const Plan& plan) {
    std::vector<int> to_copy;
    for (size_t r = 0; r < plan.resources.size(); ++r) {
        lies_[plan.resources[r].name()] = contents_[r];
        auto found = kept_.find(plan.resources[r].name());
        if (found == kept_.end()) continue;
        Kept& kept = found->second;
        if (contents_[r]) kept.content = contents_[r];
        if (plan.resources[r].needs_previous && kept.copied != kept.content) to_copy.push_back(int(r));
        kept.copied = plan.resources[r].needs_previous ? kept.content : 0;
    }
    return to_copy;
}

} // namespace bounce
