#include "graph/plan.h"

#include "core/error.h"
#include "core/text.h"
#include "graph/declared.h"
#include "graph/expression.h"
#include "graph/model.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace bounce {

namespace {

class Planner {
  public:
    Planner(const GraphModel& model, const SceneFacts& facts, glm::ivec2 size, ErrorList& errors)
        : model_(model), facts_(facts), errors_(errors), incomplete_(model.file().incomplete) {
        plan_.size = size;
    }

    Plan run() {
        resources_ = model_.file().resources;
        for (const auto& node : model_.nodes())
            declare(*node);
        check_sources(passes_, resources_, incomplete_, errors_);
        stand_in();
        decline();
        std::vector<int> order = order_passes(passes_, resources_, errors_);
        for (const ResourceDeclaration& resource : resources_)
            size_of(resource.name);
        for (Declared& pass : passes_)
            resolve_repeat(pass);
        fill(order);
        // What is wrong with a pass already, or with the size of what it uses, would only be told again in other words.
        std::erase_if(plan_.passes, [&](const PlanPass& pass) { return !judged(pass); });
        place_barriers(plan_);
        check_plan(model_, facts_, plan_, errors_);
        return std::move(plan_);
    }

  private:
    /// An error of a pass, unless it may follow from one that the file's reader told.
    void tell(Declared& pass, std::string message) {
        pass.faulty = true;
        if (!pass.node->entry.doubtful) errors_.add(std::move(message));
    }
    bool judged(const PlanPass& pass) const {
        const PassNode* node = model_.nodes()[size_t(pass.node)].get();
        for (const Declared& declared : passes_) {
            if (declared.node == node && (declared.faulty || node->entry.doubtful)) return false;
        }
        return std::none_of(pass.slots.begin(), pass.slots.end(),
                            [&](const PlanSlot& slot) { return unsized_.contains(slot.bind.resource); });
    }

    // --- declaring -------------------------------------------------------------------------------------------------
    ResourceDeclaration* find(const std::string& name) {
        for (ResourceDeclaration& resource : resources_)
            if (resource.name == name) return &resource;
        return nullptr;
    }

    static BindEntry target_of(const PassNode& node, const std::string& slot) {
        auto bound = node.entry.bind.find(slot);
        return bound != node.entry.bind.end() ? bound->second : BindEntry{slot, "", "", false};
    }

    void declare(const PassNode& node) {
        auto slots_of = [&](const std::string& name) {
            Program* program = node.program(name);
            if (!program) throw Error("pass '" + node.id() + "' has no program '" + name + "'");
            return program->slots();
        };
        Declaration declaration(facts_, plan_.size, slots_of);
        Declared pass;
        pass.node = &node;
        try {
            pass.declined = node.enabled ? node.pass->unneeded(facts_) : "switched off";
            if (pass.declined.empty() && !node.entry.needs.empty() &&
                evaluate(node.entry.needs, [&](auto& n) { return fact(n); }) == 0) {
                bool asks_parameters = node.entry.needs.find('.') != std::string::npos;
                pass.declined =
                    asks_parameters ? "it needs " + node.entry.needs : "the scene has no " + node.entry.needs;
            }
        } catch (const Error& error) {
            tell(pass, "pass '" + node.id() + "': " + error.what());
        }
        bool declared = true;
        try {
            node.pass->declare(declaration);
        } catch (const Error& error) {
            tell(pass, "pass '" + node.id() + "': " + error.what());
            declared = false;
        }
        incomplete_ = incomplete_ || !declared;
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
            pass.targets.push_back(target_of(node, use.slot));
        }
        for (const auto& [slot, bind] : node.entry.bind) {
            bool known = std::any_of(pass.uses.begin(), pass.uses.end(), [&](auto& u) { return u.slot == slot; });
            // Slots of programs that are not needed at these parameters may be bound all the same.
            for (const auto& program : node.programs)
                for (const ShaderSlot& of : program->slots())
                    known = known || of.name == slot;
            if (known) continue;
            std::vector<std::string> names;
            for (const SlotUse& use : pass.uses)
                names.push_back(use.slot);
            if (declared && !broken(node))
                tell(pass, fmt::format("pass '{}' has no slot '{}'{}", node.id(), slot, did_you_mean(slot, names)));
        }
        for (const ResourceDeclaration& made : declaration.resources())
            take_resource(pass, made);
        passes_.push_back(std::move(pass));
    }

    /// Whether the node's shaders cannot be read for the moment, so that their slots are not known.
    static bool broken(const PassNode& node) {
        return std::any_of(node.programs.begin(), node.programs.end(), [](auto& p) { return !p->errors().empty(); });
    }

    void take_resource(Declared& pass, ResourceDeclaration made) {
        const PassNode& node = *pass.node;
        bool rebound = node.entry.bind.contains(made.name);
        made.name = target_of(node, made.name).resource;
        made.declared_by = node.id();
        ResourceDeclaration* known = find(made.name);
        if (!known) {
            resources_.push_back(std::move(made));
        } else if (known->declared_by == "graph file") {
            // The file changes what it names and leaves the rest as the pass has it.
            const auto& fields = model_.file().set_fields.at(made.name);
            auto given = [&](const char* field) {
                return std::find(fields.begin(), fields.end(), field) != fields.end();
            };
            ResourceDeclaration merged = made;
            if (given("kind")) merged.kind = known->kind;
            if (given("format")) merged.format = known->format;
            if (given("size")) merged.size = known->size;
            if (given("mips")) merged.mips = known->mips;
            if (given("count")) merged.count = known->count;
            if (given("stride")) merged.stride = known->stride;
            if (given("persistent")) merged.persistent = known->persistent;
            if (given("clear")) merged.overwritten = known->overwritten;
            if (given("radiance")) merged.radiance = known->radiance;
            if (given("neutral")) merged.neutral = known->neutral;
            *known = merged;
        } else if (!rebound && known->declared_by != node.id()) {
            tell(pass, fmt::format("passes '{}' and '{}' both make '{}'; bind one of them to another name",
                                   known->declared_by, node.id(), made.name));
        }
    }

    // --- declining -------------------------------------------------------------------------------------------------
    bool all_writers_declined(const std::string& resource) const {
        bool any = false;
        for (const Declared& pass : passes_) {
            for (size_t i = 0; i < pass.uses.size(); ++i) {
                if (!pass.uses[i].writes || pass.targets[i].resource != resource) continue;
                if (pass.declined.empty()) return false;
                any = true;
            }
        }
        return any;
    }

    static bool makes_the_picture(const Declared& pass) {
        return std::any_of(pass.targets.begin(), pass.targets.end(),
                           [](auto& t) { return t.resource == "out.radiance" || t.resource == "out.display"; });
    }

    /// Everything that this pass reads from the graph comes from declined passes.
    bool starved(const Declared& pass) const {
        bool any = false;
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            const SlotUse& use = pass.uses[i];
            if (!use.reads || use.writes || is_builtin(use.slot) || pass.targets[i].previous) continue;
            if (use.optional && !has_writer(passes_, pass.targets[i].resource)) continue;
            if (!all_writers_declined(pass.targets[i].resource)) return false;
            any = true;
        }
        return any;
    }

    /// It had readers, all of them declined, and nothing of it is an output.
    bool unread(const Declared& pass) const {
        if (!pass.node->entry.enabled) return false; // a person switched it on, to look at what it makes
        bool had_readers = false;
        for (size_t i = 0; i < pass.uses.size(); ++i) {
            if (!pass.uses[i].writes) continue;
            const std::string& resource = pass.targets[i].resource;
            if (resource.starts_with("out.")) return false;
            for (const Declared& other : passes_) {
                for (size_t j = 0; j < other.uses.size(); ++j) {
                    if (&other == &pass || !other.uses[j].reads || other.targets[j].resource != resource) continue;
                    if (other.declined.empty()) return false;
                    had_readers = true;
                }
            }
        }
        return had_readers;
    }

    /// Readers of what a pass that does not run would have made get what it names instead.
    void stand_in() {
        for (const Declared& gone : passes_) {
            if (gone.declined.empty()) continue;
            for (const auto& [made, instead] : gone.node->pass->stand_ins()) {
                std::string from = target_of(*gone.node, made).resource, to = target_of(*gone.node, instead).resource;
                for (Declared& pass : passes_) {
                    for (size_t i = 0; i < pass.uses.size(); ++i)
                        if (!pass.uses[i].writes && pass.targets[i].resource == from) pass.targets[i].resource = to;
                }
            }
        }
    }

    void decline() {
        for (bool changed = true; changed;) {
            changed = false;
            for (Declared& pass : passes_) {
                if (!pass.declined.empty() || makes_the_picture(pass)) continue;
                if (starved(pass))
                    pass.declined = "all that it reads comes from declined passes";
                else if (unread(pass))
                    pass.declined = "only declined passes read what it makes";
                changed = changed || !pass.declined.empty();
            }
        }
        for (const Declared& pass : passes_)
            if (!pass.declined.empty()) plan_.declined.push_back({pass.node->id(), pass.declined});
    }

    // --- sizes -----------------------------------------------------------------------------------------------------
    std::optional<double> fact(const std::string& name) const {
        auto found = scene_fact(facts_, name);
        return found ? found : model_.number(name);
    }

    std::optional<double> number(const std::string& name) {
        if (name == "width") return plan_.size.x;
        if (name == "height") return plan_.size.y;
        if (name == "lights") return double(facts_.lights());
        if (name == "shadow_views")
            return double(facts_.spot_lights + facts_.directional_lights + 6 * facts_.point_lights);
        if (auto found = model_.number(name)) return found;
        size_t last = name.rfind('.');
        std::string resource = name.substr(0, std::min(last, name.size()));
        if (last == std::string::npos || !find(resource)) {
            doubtful_ = doubtful_ || model_.file().may_lack(name);
            return std::nullopt;
        }
        const PlanResource& sized = size_of(resource);
        doubtful_ = doubtful_ || unsized_.contains(resource);
        return side_of(sized, name.substr(last + 1));
    }

    const PlanResource& size_of(const std::string& name) {
        if (auto known = sized_.find(name); known != sized_.end()) return known->second;
        ResourceDeclaration& declaration = *find(name);
        PlanResource out;
        out.declaration = declaration;
        if (!sizing_.insert(name).second) throw Error("the size of '" + name + "' depends on itself");
        NameLookup lookup = [&](const std::string& n) { return number(n); };
        bool outer_doubtful = std::exchange(doubtful_, false);
        try {
            if (declaration.kind == ResourceKind::buffer) {
                out.count = uint64_t(evaluate_integer(declaration.count, lookup, 0));
                out.bytes = out.count * uint64_t(declaration.stride);
            } else {
                TextureDesc& desc = out.texture;
                desc.kind = declaration.kind == ResourceKind::texture_2d         ? TextureKind::texture_2d
                            : declaration.kind == ResourceKind::texture_2d_array ? TextureKind::texture_2d_array
                                                                                 : TextureKind::texture_3d;
                desc.format = format_by_name(declaration.format).internal;
                for (int i = 0; i < 3; ++i)
                    desc.size[i] = evaluate_integer(declaration.size.parts[size_t(i)], lookup, 1);
                int full = full_mip_count(desc);
                desc.mips =
                    declaration.mips == "full" ? full : std::min(full, evaluate_integer(declaration.mips, lookup, 1));
                out.bytes = texture_bytes(desc);
            }
        } catch (const Error& error) {
            if (!doubtful_)
                errors_.add(
                    fmt::format("resource '{}' (declared by {}): {}", name, declaration.declared_by, error.what()));
            doubtful_ = true;
        }
        if (doubtful_) unsized_.insert(name);
        doubtful_ = outer_doubtful;
        sizing_.erase(name);
        return sized_[name] = out;
    }

    void resolve_repeat(Declared& pass) {
        const RepeatEntry& repeat = pass.node->entry.repeat;
        if (repeat.over.empty()) return;
        pass.loop = repeat.loop;
        NameLookup lookup = [&](const std::string& n) { return number(n); };
        doubtful_ = false;
        try {
            pass.repeat_from = evaluate_integer(repeat.from, lookup, 0);
            if (repeat.over == "count")
                pass.repeat_to = evaluate_integer(repeat.count, lookup, 0);
            else if (repeat.over == "lights")
                pass.repeat_to = int(facts_.lights());
            else if (repeat.over == "views")
                pass.repeat_to = int(*number("shadow_views"));
            else if (!find(repeat.of)) {
                doubtful_ = incomplete_;
                throw Error("repeats over '" + repeat.of + "', which nothing declares");
            } else
                pass.repeat_to =
                    repeat.over == "mips" ? size_of(repeat.of).texture.mips : size_of(repeat.of).texture.size.z;
        } catch (const Error& error) {
            if (!doubtful_) tell(pass, "pass '" + pass.node->id() + "': " + error.what());
            pass.faulty = true;
        }
    }

    // --- the result ------------------------------------------------------------------------------------------------
    void fill(const std::vector<int>& order) {
        std::map<std::string, int> index;
        for (const ResourceDeclaration& resource : resources_) {
            bool used = false;
            for (int p : order) {
                for (const BindEntry& target : passes_[p].targets)
                    used = used || target.resource == resource.name;
            }
            if (!used || all_writers_declined(resource.name)) continue;
            index[resource.name] = int(plan_.resources.size());
            plan_.resources.push_back(sized_[resource.name]);
        }
        std::set<int> written;
        for (int p : order) {
            const Declared& declared = passes_[p];
            PlanPass pass;
            for (size_t n = 0; n < model_.nodes().size(); ++n) {
                if (model_.nodes()[n].get() == declared.node) pass.node = int(n);
            }
            pass.id = declared.node->id();
            pass.programs = declared.programs;
            pass.repeat_from = declared.repeat_from;
            pass.repeat_to = declared.repeat_to;
            pass.loop = declared.loop;
            pass.facts_read = declared.facts_read;
            pass.picture_size_read = declared.picture_size_read;
            for (size_t i = 0; i < declared.uses.size(); ++i) {
                PlanSlot slot{declared.uses[i],    -1,        is_builtin(declared.uses[i].slot), glm::vec4(0),
                              declared.targets[i], plan_.size};
                if (const ResourceDeclaration* known = find(slot.bind.resource)) {
                    slot.neutral = known->neutral;
                    slot.neutral_size = glm::ivec2(sized_[known->name].texture.size);
                }
                auto found = index.find(slot.bind.resource);
                if (!slot.builtin && found != index.end()) {
                    slot.resource = found->second;
                    PlanResource& resource = plan_.resources[size_t(slot.resource)];
                    if (slot.bind.previous) resource.needs_previous = true;
                    auto add = [&](std::vector<std::string>& ids) {
                        if (std::find(ids.begin(), ids.end(), pass.id) == ids.end()) ids.push_back(pass.id);
                    };
                    if (slot.use.writes) add(resource.writers);
                    if (slot.use.reads) add(resource.readers);
                    if (slot.use.writes && written.insert(slot.resource).second && !resource.declaration.persistent &&
                        !resource.declaration.incremental && !resource.declaration.overwritten) {
                        pass.clears.push_back(slot.resource);
                    }
                }
                pass.slots.push_back(std::move(slot));
            }
            for (const CounterDeclaration& counter : declared.counters) {
                auto found = index.find(counter.buffer);
                if (found != index.end())
                    pass.counters.push_back({counter.label, found->second, counter.element, counter.overflow});
            }
            plan_.passes.push_back(std::move(pass));
        }
    }

    const GraphModel& model_;
    const SceneFacts& facts_;
    Plan plan_;
    ErrorList& errors_;
    std::vector<ResourceDeclaration> resources_;
    std::vector<Declared> passes_;
    std::map<std::string, PlanResource> sized_;
    std::set<std::string> sizing_;
    bool incomplete_;               ///< there may be more resources than these
    std::set<std::string> unsized_; ///< resources whose size has an error, or uses one that has
    bool doubtful_ = false;         ///< the expression at hand names what is not known because of another error
};

} // namespace

Plan make_plan(const GraphModel& model, const SceneFacts& facts, glm::ivec2 size, ErrorList& errors) {
    model.note_numbers(true);
    Plan plan = Planner(model, facts, size, errors).run();
    plan.numbers = model.note_numbers(false);
    return plan;
}

Plan GraphModel::plan(const SceneFacts& facts, glm::ivec2 size) const {
    ErrorList errors;
    Plan plan = make_plan(*this, facts, size, errors);
    errors.throw_if_any("graph '" + file_.name + "'");
    return plan;
}

} // namespace bounce
