// Finds what is wrong with a plan before a frame runs into it.
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace bounce {

namespace {

class PlanChecker {
  public:
    PlanChecker(const GraphModel& model, const SceneFacts& facts, const Plan& plan, ErrorList& errors)
        : model_(model), facts_(facts), plan_(plan), errors_(errors) {}

    void run() {
        for (const PlanPass& pass : plan_.passes) {
            const PassNode& node = *model_.nodes()[size_t(pass.node)];
            for (const PlanSlot& slot : pass.slots)
                check_bind(pass, slot);
            for (const auto& program : node.programs) {
                if (!pass.runs(program->name())) continue;
                for (const ShaderSlot& slot : program->slots())
                    check_kind(pass, slot);
            }
            bool readable =
                std::all_of(node.programs.begin(), node.programs.end(), [](auto& p) { return p->errors().empty(); });
            if (node.entry.type == "compute" && readable) check_dispatch(node.entry.dispatch, pass);
        }
        check_loops();
    }

  private:
    /// Passes of a loop follow one another and have the same steps.
    void check_loops() {
        std::map<std::string, size_t> last; // loop → its last pass so far
        for (size_t i = 0; i < plan_.passes.size(); ++i) {
            const PlanPass& pass = plan_.passes[i];
            if (pass.loop.empty()) continue;
            auto known = last.find(pass.loop);
            if (known != last.end()) {
                const PlanPass& before = plan_.passes[known->second];
                if (known->second + 1 != i)
                    error(pass, fmt::format(" is of the loop '{}', as pass '{}' is, but others run between them",
                                            pass.loop, before.id));
                else if (pass.repeat_from != before.repeat_from || pass.repeat_to != before.repeat_to)
                    error(pass, fmt::format(" takes the steps {} … {} of the loop '{}', and pass '{}' {} … {}",
                                            pass.repeat_from, pass.repeat_to - 1, pass.loop, before.id,
                                            before.repeat_from, before.repeat_to - 1));
            }
            last[pass.loop] = i;
        }
    }

    void error(const PlanPass& pass, const std::string& message) {
        std::string text = "pass '" + pass.id + "'" + message;
        const auto& known = errors_.messages();
        if (std::find(known.begin(), known.end(), text) == known.end()) errors_.add(text);
    }

    /// Evaluates at the first and the last step; returns the greater value.
    std::optional<int> evaluate_steps(const PlanPass& pass, const std::string& what, const std::string& expression) {
        std::optional<int> greatest;
        for (int step : {pass.repeat_from, pass.repeat_to - 1}) {
            if (step < pass.repeat_from) continue; // no steps at all
            try {
                Scope scope{model_, &facts_, {}, {}, {}, step};
                greatest =
                    std::max(greatest.value_or(0), evaluate_integer(expression, scope.of_plan(plan_).names(), 0));
            } catch (const Error& failure) {
                std::string at = pass.repeat_to - pass.repeat_from > 1 ? fmt::format(" in step {}", step) : "";
                error(pass, fmt::format(": {}{}: {}", what, at, failure.what()));
                return std::nullopt;
            }
        }
        return greatest;
    }

    void check_bind(const PlanPass& pass, const PlanSlot& slot) {
        const std::string& name = slot.bind.resource;
        if (slot.bind.previous && slot.use.writes)
            error(pass, fmt::format(" writes '{}' through slot '{}': last frame's copy can only be read", name,
                                    slot.use.slot));
        if (slot.resource < 0) return;
        const TextureDesc& desc = plan_.resources[size_t(slot.resource)].texture;
        int layers = desc.kind == TextureKind::texture_2d ? 1 : desc.size.z;
        auto check = [&](const char* what, const std::string& expression, int count) {
            if (expression.empty()) return;
            auto index = evaluate_steps(pass, fmt::format("the {} of slot '{}'", what, slot.use.slot), expression);
            if (index && *index >= count)
                error(pass, fmt::format(" binds {} {} of '{}', which has {}", what, *index, name, count));
        };
        check("mip", slot.bind.mip, desc.mips);
        check("layer", slot.bind.layer, layers);
    }

    /// A sampler or image against the texture behind it.
    void check_kind(const PlanPass& pass, const ShaderSlot& slot) {
        const PlanSlot* bound = pass.find(slot.name);
        if (!bound || bound->resource < 0 || slot.kind == SlotKind::storage || !slot.certain) return;
        const PlanResource& resource = plan_.resources[size_t(bound->resource)];
        if (resource.is_buffer()) return; // told already
        const Format& format = format_by_enum(resource.texture.format);
        std::string type = slot.type;
        FormatClass wanted = type.starts_with("u")                                  ? FormatClass::unsigned_integer
                             : type.starts_with("is") || type.starts_with("iimage") ? FormatClass::signed_integer
                                                                                    : FormatClass::floating;
        bool image = slot.kind == SlotKind::image;
        std::string shape = type.substr(type.find(image ? "image" : "sampler") + (image ? 5 : 7));
        if (shape.ends_with("Shadow")) shape.resize(shape.size() - 6);
        bool one_layer = !bound->bind.layer.empty();
        TextureKind kind = resource.texture.kind;
        bool fits = shape == "2D" ? kind == TextureKind::texture_2d ||
                                        (one_layer && (image || kind == TextureKind::texture_2d_array))
                    : shape == "2DArray" ? kind == TextureKind::texture_2d_array
                                         : shape == "3D" && kind == TextureKind::texture_3d;
        std::string uses = fmt::format(" ({}) uses '{}' as a {}, but", slot.where, resource.name(), type);
        if (!fits) {
            bool layers = shape == "2D" && kind != TextureKind::texture_2d;
            error(pass, fmt::format("{} it is a {}{}", uses, to_string(resource.declaration.kind),
                                    layers ? " (bind one layer of it)" : ""));
        } else if (format.is_integer() ? wanted != format.kind : wanted != FormatClass::floating) {
            error(pass, fmt::format("{} its format is {}", uses, format.name));
        } else if (image && !format.image) {
            error(pass, fmt::format("{} its format, {}, is not one that shaders can store to", uses, format.name));
        }
    }

    void check_dispatch(const DispatchEntry& dispatch, const PlanPass& pass) {
        if (!dispatch.indirect.empty()) return;
        for (const std::string& threads : dispatch.threads)
            evaluate_steps(pass, "'dispatch'", threads);
        if (!dispatch.threads.empty()) return;
        bool slot_found = false;
        for (const PlanSlot& slot : pass.slots) {
            bool named = slot.bind.resource == dispatch.resource || slot.use.slot == dispatch.resource;
            bool texture = slot.use.usage != Usage::storage && slot.use.usage != Usage::indirect;
            slot_found =
                slot_found || (texture && slot.resource >= 0 && (dispatch.resource.empty() ? slot.use.writes : named));
        }
        if (slot_found) return;
        if (dispatch.resource.empty()) {
            error(pass, " has nothing to dispatch over: give \"dispatch\": [x, y, z] or the name of a texture");
            return;
        }
        const PlanResource* resource = plan_.find_resource(dispatch.resource);
        if (resource && !resource->is_buffer()) return;
        std::vector<std::string> names;
        for (const PlanResource& known : plan_.resources)
            if (!known.is_buffer()) names.push_back(known.name());
        error(pass, fmt::format(" dispatches over '{}', which is no texture here{}", dispatch.resource,
                                did_you_mean(dispatch.resource, names)));
    }

    const GraphModel& model_;
    const SceneFacts& facts_;
    const Plan& plan_;
    ErrorList& errors_;
};

} // namespace

void check_plan(const GraphModel& model, const SceneFacts& facts, const Plan& plan, ErrorList& errors) {
    PlanChecker(model, facts, plan, errors).run();
}

} // namespace bounce
