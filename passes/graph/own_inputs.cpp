#include "graph/own_inputs.h"

#include "core/digest.h"
#include "gpu_scene/frame_constants.h"
#include "graph/graph.h"
#include "graph/scope.h"

#include <algorithm>

namespace bounce {

namespace {

class OwnInputs {
  public:
    OwnInputs(const GraphModel& model, const Plan& plan, const PlanPass& pass, const FrameInputs& frame)
        : model_(model), plan_(plan), pass_(pass), node_(*model.nodes()[size_t(pass.node)]), frame_(frame) {}

    void shape(const Allocations& allocations) {
        Digest& d = lasting();
        d.add(node_.entry.type).add(pass_.repeat_from).add(pass_.repeat_to).add(pass_.loop);
        for (const PlanSlot& slot : pass_.slots) {
            d.add(slot.use.slot).add(slot.use.usage).add(slot.use.reads).add(slot.use.writes);
            d.add(slot.bind.resource).add(slot.bind.mip).add(slot.bind.layer).add(slot.bind.previous);
            if (slot.resource < 0) {
                d.add(-1).add(slot.neutral).add(slot.neutral_size);
                continue;
            }
            const PlanResource& resource = plan_.resources[size_t(slot.resource)];
            const TextureDesc& t = resource.texture;
            d.add(resource.declaration.kind).add(t.format).add(t.size).add(t.mips).add(resource.bytes);
            // A new object of the same shape holds nothing yet.
            if (slot.use.writes) d.add(allocations.serial(slot.resource));
        }
        const DispatchEntry& dispatch = node_.entry.dispatch;
        d.add(dispatch.resource).add(dispatch.indirect);
        for (const std::string& threads : dispatch.threads)
            d.add(threads);
        for (const ByteRange& range : pass_.facts_read)
            bytes(d, *frame_.facts, range);
        if (pass_.picture_size_read) d.add(plan_.size);
    }

    /// Parameters in C++ reach execute() by members.
    void parameters() {
        for (const Parameter& parameter : node_.parameters.all())
            if (!parameter.info.in_shader) value(parameter);
    }

    void programs() {
        for (const auto& program : node_.programs) {
            if (!pass_.runs(program->name())) continue;
            lasting().add(program->name()).add(program->text_digest());
            if (program->usable()) uses(program->interface());
        }
    }

    void looks(const PassInputs& looked) {
        for (const ByteRange& range : looked.frame)
            constant(range);
        for (const ByteRange& range : looked.facts)
            bytes(lasting(), *frame_.facts, range);
        for (ScenePart part : looked.scene)
            scene(part);
        Scope scope{model_, frame_.facts, {}, {}, {}, {}};
        scope.of_plan(plan_);
        for (const std::string& name : looked.numbers)
            lasting().add(name).add(scope.number(name).value_or(0));
    }

    Revision result() const {
        Revision out;
        for (int i = 0; i < k_causes; ++i)
            out.by_cause[size_t(i)] = digests_[size_t(i)].value();
        return out;
    }

  private:
    Digest& by(Cause cause) { return digests_[size_t(cause)]; }
    Digest& lasting() { return by(Cause::lasting); }

    template <class T>
    static void bytes(Digest& digest, const T& of, const ByteRange& range) {
        digest.add(range.first).bytes(reinterpret_cast<const char*>(&of) + range.first, range.second);
    }

    void value(const Parameter& parameter) {
        lasting().add(parameter.info.name);
        std::visit([&](const auto& v) { lasting().add(v); }, parameter.value);
    }

    void constant(const ByteRange& range) {
        for (const FrameConstant& known : frame_constants())
            if (known.offset == range.first) bytes(by(known.cause), frame_.constants, range);
    }

    void scene(ScenePart part) {
        const Revision& revision = frame_.scene->revision(part);
        for (int i = 0; i < k_causes; ++i)
            digests_[size_t(i)].add(part).add(revision.by_cause[size_t(i)]);
    }

    void uses(const ProgramInterface& interface) {
        const auto& set_by_pass = node_.description->constants;
        for (const UniformInfo& uniform : interface.uniforms) {
            if (std::find(set_by_pass.begin(), set_by_pass.end(), uniform.name) != set_by_pass.end()) continue;
            if (const FrameConstant* known = find_frame_constant(uniform.name))
                constant({known->offset, known->size});
            else if (const Parameter* parameter = model_.parameter_of(node_, uniform.name))
                value(*parameter);
        }
        for (const OpaqueInfo& sampler : interface.samplers) {
            if (sampler.name == "scene_environment") scene(ScenePart::environment);
            if (sampler.name == "scene_textures") scene(ScenePart::textures);
        }
        for (const BlockInfo& block : interface.storage_blocks) {
            if (block.name == "scene_vertices" || block.name == "scene_indices") scene(ScenePart::geometry);
            if (block.name == "scene_materials") scene(ScenePart::materials);
            if (block.name == "scene_lights") scene(ScenePart::lights);
            if (block.name == "scene_draws") {
                scene(ScenePart::static_draws);
                scene(ScenePart::dynamic_draws);
            }
        }
    }

    const GraphModel& model_;
    const Plan& plan_;
    const PlanPass& pass_;
    const PassNode& node_;
    const FrameInputs& frame_;
    std::array<Digest, k_causes> digests_;
};

} // namespace

Revision digest_own_inputs(const GraphModel& model, const Plan& plan, const PlanPass& pass,
                           const Allocations& allocations, const FrameInputs& frame, const PassInputs& looked) {
    OwnInputs inputs(model, plan, pass, frame);
    inputs.shape(allocations);
    inputs.parameters();
    inputs.programs();
    inputs.looks(looked);
    return inputs.result();
}

bool slot_is_active(const GraphModel& model, const PlanPass& pass, const PlanSlot& slot) {
    if (slot.use.usage == Usage::colour || slot.use.usage == Usage::depth || slot.use.usage == Usage::indirect)
        return true; // no program's business
    std::string identifier = slot_identifier(slot.use.slot);
    auto named = [&](const auto& list) {
        return std::any_of(list.begin(), list.end(), [&](auto& entry) { return entry.name == identifier; });
    };
    bool of_a_shader = false;
    for (const auto& program : model.nodes()[size_t(pass.node)]->programs) {
        if (!pass.runs(program->name())) continue;
        const ProgramInterface& used = program->interface();
        if (!program->usable() || named(used.samplers) || named(used.images) || named(used.storage_blocks)) return true;
        for (const ShaderSlot& known : program->slots())
            of_a_shader = of_a_shader || known.name == slot.use.slot;
    }
    return !of_a_shader;
}

bool follows_camera(const GraphModel& model, const PlanPass& pass) {
    for (const auto& program : model.nodes()[size_t(pass.node)]->programs) {
        if (!pass.runs(program->name()) || !program->usable()) continue;
        for (const UniformInfo& uniform : program->interface().uniforms)
            if (uniform.name == "previous_view_projection") return true;
    }
    return false;
}

} // namespace bounce
