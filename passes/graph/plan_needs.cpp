#include "graph/plan_needs.h"

#include "core/limits.h"
#include "gpu/driver_limits.h"
#include "graph/plan_remedy.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace bounce {

namespace {

/// The limits that each stage has of its own.
struct StageLimits {
    const char* name;
    GLenum samplers, images, storage_blocks, uniform_blocks, uniform_components;
};

const StageLimits& limits_of(ShaderStage stage) {
    static const StageLimits all[] = {
        {"vertex", GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, GL_MAX_VERTEX_IMAGE_UNIFORMS, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS,
         GL_MAX_VERTEX_UNIFORM_BLOCKS, GL_MAX_VERTEX_UNIFORM_COMPONENTS},
        {"geometry", GL_MAX_GEOMETRY_TEXTURE_IMAGE_UNITS, GL_MAX_GEOMETRY_IMAGE_UNIFORMS,
         GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, GL_MAX_GEOMETRY_UNIFORM_BLOCKS, GL_MAX_GEOMETRY_UNIFORM_COMPONENTS},
        {"fragment", GL_MAX_TEXTURE_IMAGE_UNITS, GL_MAX_FRAGMENT_IMAGE_UNIFORMS, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS,
         GL_MAX_FRAGMENT_UNIFORM_BLOCKS, GL_MAX_FRAGMENT_UNIFORM_COMPONENTS},
        {"compute", GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, GL_MAX_COMPUTE_IMAGE_UNIFORMS,
         GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, GL_MAX_COMPUTE_UNIFORM_BLOCKS, GL_MAX_COMPUTE_UNIFORM_COMPONENTS}};
    return all[int(stage)];
}

class Needs {
  public:
    Needs(GraphModel& model, const Plan& plan) : model_(model), plan_(plan) {}

    std::vector<PlanNeed> run() {
        for (const PlanPass& pass : plan_.passes) {
            PassNode& node = *model_.nodes()[size_t(pass.node)];
            model_.scan(node, pass_defines(plan_, pass));
            for (const auto& program : node.programs)
                if (pass.runs(program->name())) of_program(pass, *program);
        }
        for (const PlanResource& resource : plan_.resources)
            of_resource(resource);
        return std::move(needs_);
    }

  private:
    void add(const std::string& pass, const std::string& what, const std::string& of, int64_t value, GLenum limit,
             int axis = 0) {
        if (value > 0) needs_.push_back({pass, what, of, value, limit, axis});
    }

    void of_program(const PlanPass& pass, const Program& program) {
        std::set<std::string> images, blocks; // one of several stages has one unit
        int64_t samplers = 0, image_uses = 0, block_uses = 0, outputs = 0;
        for (size_t i = 0; i < program.sources().size(); ++i) {
            const std::string file = program.stages()[i].string();
            const ShaderNeeds needs = shader_needs(program.sources()[i].text, stage_of(program.stages()[i]));
            of_stage(pass, file, needs);
            images.insert(needs.images.begin(), needs.images.end());
            blocks.insert(needs.storage_blocks.begin(), needs.storage_blocks.end());
            samplers += int64_t(needs.samplers.size());
            image_uses += int64_t(needs.images.size());
            block_uses += int64_t(needs.storage_blocks.size());
            outputs += needs.outputs;
        }
        const std::string file = program.stages().back().string();
        const auto of_all = [&](const char* what, int64_t value, GLenum limit) {
            add(pass.id, what, file, value, limit);
        };
        of_all("samplers in a program", samplers, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
        of_all("image units", int64_t(images.size()), GL_MAX_IMAGE_UNITS);
        of_all("images in a program", image_uses, GL_MAX_COMBINED_IMAGE_UNIFORMS);
        of_all("storage buffers", int64_t(blocks.size()), GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
        of_all("storage blocks in a program", block_uses, GL_MAX_COMBINED_SHADER_STORAGE_BLOCKS);
        of_all("images, storage blocks and colours together", image_uses + block_uses + outputs,
               GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES);
        of_all("colours", outputs, GL_MAX_DRAW_BUFFERS);
    }

    void of_stage(const PlanPass& pass, const std::string& file, const ShaderNeeds& needs) {
        const StageLimits& limits = limits_of(needs.stage);
        const auto in_stage = [&](const char* what, int64_t value, GLenum limit) {
            add(pass.id, fmt::format("{} in a {} shader", what, limits.name), file, value, limit);
        };
        in_stage("samplers", int64_t(needs.samplers.size()), limits.samplers);
        in_stage("images", int64_t(needs.images.size()), limits.images);
        in_stage("storage blocks", int64_t(needs.storage_blocks.size()), limits.storage_blocks);
        in_stage("uniform blocks", int64_t(needs.uniform_blocks.size()), limits.uniform_blocks);
        in_stage("words of uniforms", needs.uniform_components, limits.uniform_components);
        add(pass.id, "bytes of a uniform block", file, needs.uniform_block_bytes, GL_MAX_UNIFORM_BLOCK_SIZE);
        add(pass.id, "vertices of a geometry shader", file, needs.output_vertices, GL_MAX_GEOMETRY_OUTPUT_VERTICES);
        if (needs.layer_from_vertex && !driver_has("GL_ARB_shader_viewport_layer_array"))
            add(pass.id,
                "layers chosen by a vertex shader (GL_ARB_shader_viewport_layer_array; choose them in a "
                "geometry shader)",
                file, 1, GL_ZERO);
        if (needs.stage != ShaderStage::compute) return;
        add(pass.id, "bytes of shared memory", file, needs.shared_bytes, GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
        const glm::ivec3 size = needs.local_size;
        add(pass.id, "invocations in a work group", file, int64_t(size.x) * size.y * size.z,
            GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
        for (int axis = 0; axis < 3; ++axis)
            add(pass.id, fmt::format("invocations along {} of a work group", "xyz"[axis]), file, size[axis],
                GL_MAX_COMPUTE_WORK_GROUP_SIZE, axis);
    }

    void of_resource(const PlanResource& resource) {
        const std::string pass = resource.writers.empty() ? std::string() : resource.writers.front();
        const std::string name = resource.name();
        const auto of = [&](const char* what) { return fmt::format("{} '{}'", what, name); };
        if (resource.is_buffer()) {
            add(pass, of("bytes of the buffer"), "", int64_t(resource.bytes), GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
            return;
        }
        const TextureDesc& desc = resource.texture;
        const bool volume = desc.kind == TextureKind::texture_3d;
        const GLenum side = volume ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE;
        add(pass, of("texels of the width of"), "", desc.size.x, side);
        add(pass, of("texels of the height of"), "", desc.size.y, side);
        if (volume) add(pass, of("texels of the depth of"), "", desc.size.z, side);
        if (desc.kind == TextureKind::texture_2d_array)
            add(pass, of("layers of"), "", desc.size.z, GL_MAX_ARRAY_TEXTURE_LAYERS);
    }

    GraphModel& model_;
    const Plan& plan_;
    std::vector<PlanNeed> needs_;
};

/// The same need of another plan; 0 where there is none.
double same_need(GraphModel& model, const Plan& plan, const PlanNeed& need) {
    for (const PlanNeed& other : plan_needs(model, plan))
        if (other.pass == need.pass && other.what == need.what && other.of == need.of) return double(other.value);
    return 0;
}

} // namespace

Defines pass_defines(const Plan& plan, const PlanPass& pass) {
    Defines defines;
    for (const PlanSlot& slot : pass.slots) {
        if (slot.use.optional && slot.resource >= 0) defines["HAS_" + slot_identifier(slot.use.slot)] = "1";
        if (slot.use.usage != Usage::image) continue;
        std::string format = "rgba16f";
        if (slot.resource >= 0) format = plan.resources[size_t(slot.resource)].declaration.format;
        defines["FORMAT_" + slot_identifier(slot.use.slot)] = format;
    }
    return defines;
}

std::vector<PlanNeed> plan_needs(GraphModel& model, const Plan& plan) {
    return Needs(model, plan).run();
}

void check_plan_limits(GraphModel& model, const SceneFacts& facts, const Plan& plan) {
    constexpr size_t k_told = 8, k_remedies = 2; // each of these asks for many plans
    ErrorList errors;
    std::set<std::string> seen; // several programs of a pass share a stage
    for (const PlanNeed& need : plan_needs(model, plan)) {
        const int64_t limit = need.limit == GL_ZERO ? 0 : driver_limit(need.limit, need.axis);
        if (need.value <= limit || errors.messages().size() >= k_told) continue;
        if (!seen.insert(need.pass + need.what + need.of).second) continue;
        std::string text = fmt::format("pass '{}'{} needs {} {}; this driver allows {}", need.pass,
                                       need.of.empty() ? "" : " (" + need.of + ")", grouped(uint64_t(need.value)),
                                       need.what, grouped(uint64_t(limit)));
        if (need.limit == GL_ZERO) {
            text = fmt::format("pass '{}' ({}) needs {}, which this driver lacks", need.pass, need.of, need.what);
        } else {
            text += fmt::format(" ({})", limit_name(need.limit));
            if (errors.messages().size() >= k_remedies) {
                errors.add(text);
                continue;
            }
            const std::string remedy = plan_remedy(
                model, facts, plan, [&](GraphModel& of, const Plan& other) { return same_need(of, other, need); },
                [](double value) { return grouped(uint64_t(value)); }, true);
            text += remedy.empty() ? ", and no parameter lowers it" : ": " + remedy;
        }
        errors.add(text);
    }
    errors.throw_if_any(fmt::format("graph '{}'", model.file().name));
}

std::string needs_text(const std::vector<PlanNeed>& needs) {
    std::vector<PlanNeed> largest;
    for (const PlanNeed& need : needs) {
        auto same = std::find_if(largest.begin(), largest.end(), [&](const PlanNeed& other) {
            return other.limit == need.limit && other.axis == need.axis;
        });
        if (same == largest.end())
            largest.push_back(need);
        else if (need.value > same->value)
            *same = need;
    }
    std::string text;
    for (const PlanNeed& need : largest) {
        if (need.limit == GL_ZERO) continue;
        int64_t minimum = 0;
        for (const DriverLimit& limit : driver_limits())
            if (limit.name == need.limit) minimum = limit.minimum;
        text += fmt::format("  {:>11} of {:>11}  {} ({})\n", grouped(uint64_t(need.value)), grouped(uint64_t(minimum)),
                            need.what, need.pass);
    }
    return text;
}

} // namespace bounce
