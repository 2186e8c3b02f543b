#include "graph/context.h"

#include "core/error.h"
#include "core/limits.h"
#include "gpu/barrier.h"
#include "gpu/driver_limits.h"
#include "graph/graph.h"
#include "graph/scope.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

const SceneFacts& PassContext::facts() const {
    return *graph_.inputs_->facts;
}
const FrameConstants& PassContext::frame() const {
    return graph_.inputs_->constants;
}
const GpuScene& PassContext::scene(std::initializer_list<ScenePart> parts) const {
    inputs_.scene.insert(parts);
    return *graph_.inputs_->scene;
}
const std::vector<GpuDraw>& PassContext::draws() const {
    return scene({ScenePart::static_draws, ScenePart::dynamic_draws}).draw_list();
}
const std::vector<GpuLight>& PassContext::lights() const {
    return scene({ScenePart::lights}).light_list();
}
const std::vector<Material>& PassContext::materials() const {
    return scene({ScenePart::materials}).material_list();
}
const Revision& PassContext::revision(ScenePart part) const {
    return scene({part}).revision(part);
}
std::vector<Vertex> PassContext::read_vertices() const {
    return scene({ScenePart::geometry}).vertices().read_all<Vertex>();
}
std::vector<uint32_t> PassContext::read_indices() const {
    return scene({ScenePart::geometry}).indices().read_all<uint32_t>();
}
const GpuTexture& PassContext::environment() const {
    return scene({ScenePart::environment}).environment();
}

const PlanSlot& PassContext::slot(const std::string& name) const {
    if (const PlanSlot* found = pass_.find(name)) return *found;
    throw Error("pass '" + pass_.id + "' has no slot '" + name + "'");
}

bool PassContext::has(const std::string& name) const {
    const PlanSlot* found = pass_.find(name);
    return found && found->resource >= 0;
}

bool PassContext::stands(const std::string& name) const {
    const PlanSlot& s = slot(name);
    return s.resource >= 0 && graph_.invalidation_.stands(s.resource);
}

const GpuTexture& PassContext::texture(const std::string& name) const {
    const PlanSlot& s = slot(name);
    if (s.resource < 0) throw Error("slot '" + name + "' of pass '" + pass_.id + "' has no texture");
    return graph_.allocations_.texture(s.resource, s.bind.previous);
}

const Buffer& PassContext::buffer(const std::string& name) const {
    const PlanSlot& s = slot(name);
    if (s.resource < 0) throw Error("slot '" + name + "' of pass '" + pass_.id + "' has no buffer");
    return graph_.allocations_.buffer(s.resource, s.bind.previous);
}

std::optional<double> PassContext::number(const std::string& name) const {
    // The step is no input of the pass: every step of it runs.
    if (name != "iteration") inputs_.numbers.insert(name);
    return Scope{*graph_.model_, &facts(), {}, {}, {}, iteration}.of_plan(graph_.plan_).number(name);
}

int PassContext::integer(const std::string& expression) const {
    if (expression == "iteration") return iteration;
    Scope scope{*graph_.model_, &facts(), {}, {}, {}, iteration};
    Names names = scope.of_plan(graph_.plan_).names();
    names.value = [this](const std::string& name) { return number(name); };
    return evaluate_integer(expression, names, 0);
}

/// The mip or layer that a bind entry names at this step; −1 when it names none.
int PassContext::index_at(const std::string& expression) const {
    return expression.empty() ? -1 : integer(expression);
}

glm::ivec3 PassContext::size(const std::string& name) const {
    const PlanSlot& s = slot(name);
    int mip = index_at(s.bind.mip);
    glm::ivec3 size = mip_size(texture(name).desc(), std::max(mip, 0));
    if (!s.bind.layer.empty() && texture(name).desc().kind == TextureKind::texture_2d_array) size.z = 1;
    return size;
}

void PassContext::set(const std::string& name, const ParameterValue& value) {
    for (auto& [known, old] : constants_) {
        if (known == name) {
            old = value;
            return;
        }
    }
    constants_.emplace_back(name, value);
}

void PassContext::bind_mip(const std::string& slot_name, int mip) {
    for (auto& [known, old] : mips_) {
        if (known == slot_name) {
            old = mip;
            return;
        }
    }
    mips_.emplace_back(slot_name, mip);
}

/// The mip that bind_mip or the graph file binds the slot to; −1: all of them.
int PassContext::mip_of(const PlanSlot& slot) const {
    for (const auto& [name, mip] : mips_)
        if (name == slot.use.slot) return mip;
    return index_at(slot.bind.mip);
}

/// The plan's buffers were checked before; the scene's are as large as the scene.
static void check_block_size(const std::string& name, uint64_t bytes) {
    const int64_t limit = driver_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    if (int64_t(bytes) > limit)
        throw Error(fmt::format("'{}' has {} bytes; this driver's storage blocks hold {} "
                                "(GL_MAX_SHADER_STORAGE_BLOCK_SIZE): use a smaller scene",
                                slot_name(name), grouped(bytes), grouped(uint64_t(limit))));
}

static bool sampler_is_2d(GLenum type) {
    return type == GL_SAMPLER_2D || type == GL_INT_SAMPLER_2D || type == GL_UNSIGNED_INT_SAMPLER_2D ||
           type == GL_SAMPLER_2D_SHADOW;
}

static bool image_is_2d(GLenum type) {
    return type == GL_IMAGE_2D || type == GL_INT_IMAGE_2D || type == GL_UNSIGNED_INT_IMAGE_2D;
}

Program& PassContext::use(const std::string& name) {
    PassNode& node = *graph_.model_->nodes()[size_t(pass_.node)];
    Program* program = node.program(name);
    if (!program) throw Error("pass '" + pass_.id + "' has no program '" + name + "'");
    glUseProgram(program->id());
    const ProgramInterface& interface = program->interface();
    const GpuScene& scene = *graph_.inputs_->scene; // what a program uses of it is an input by reflection

    for (const UniformInfo& uniform : interface.uniforms) {
        auto constant =
            std::find_if(constants_.begin(), constants_.end(), [&](auto& c) { return c.first == uniform.name; });
        if (constant != constants_.end())
            set_uniform(program->id(), uniform, constant->second);
        else if (uniform.name == "iteration")
            set_uniform(program->id(), uniform, iteration);
        else if (uniform.name == "repeat_from")
            set_uniform(program->id(), uniform, pass_.repeat_from);
        else if (uniform.name == "repeat_to")
            set_uniform(program->id(), uniform, pass_.repeat_to);
        else if (const FrameConstant* known = find_frame_constant(uniform.name))
            set_frame_constant(program->id(), uniform, *known, frame());
        else if (const Parameter* p = graph_.model_->parameter_of(node, uniform.name))
            set_uniform(program->id(), uniform, p->value);
    }

    for (const OpaqueInfo& sampler : interface.samplers) {
        if (sampler.name == "scene_textures") {
            for (int i = 0; i < sampler.count; ++i) {
                glBindTextureUnit(GLuint(sampler.unit + i), scene.texture_array(i).id());
                glBindSampler(GLuint(sampler.unit + i), scene.texture_array_sampler(i));
            }
            continue;
        }
        if (sampler.name.starts_with("material_")) continue; // by draw
        bool shadow = sampler.type == GL_SAMPLER_2D_SHADOW || sampler.type == GL_SAMPLER_2D_ARRAY_SHADOW;
        GLuint texture = 0;
        const PlanSlot* s = pass_.find(slot_name(sampler.name));
        if (sampler.name == "scene_environment")
            texture = scene.environment().id();
        else if (sampler.name == "scene_lobe_albedo")
            texture = scene.lobe_albedo().id();
        else if (s && s->resource >= 0) {
            texture = graph_.allocations_
                          .view(s->resource, s->bind.previous, mip_of(*s), index_at(s->bind.layer),
                                sampler_is_2d(sampler.type))
                          .id();
        } else {
            texture = graph_.neutral_texture(sampler.type, s ? s->neutral : glm::vec4(0),
                                             s ? s->neutral_size : glm::ivec2(1));
        }
        glBindTextureUnit(GLuint(sampler.unit), texture);
        glBindSampler(GLuint(sampler.unit), shadow ? graph_.comparison_sampler_.id() : 0);
    }

    for (const OpaqueInfo& image : interface.images) {
        const PlanSlot* s = pass_.find(slot_name(image.name));
        if (!s || s->resource < 0) {
            glBindImageTexture(GLuint(image.unit), 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA16F);
            continue;
        }
        const GpuTexture& texture = graph_.allocations_.texture(s->resource, s->bind.previous);
        int mip = std::clamp(mip_of(*s), 0, texture.desc().mips - 1);
        int layer = index_at(s->bind.layer);
        bool layered = texture.desc().kind != TextureKind::texture_2d && !image_is_2d(image.type);
        GLenum access = s->use.writes ? (s->use.reads ? GL_READ_WRITE : GL_WRITE_ONLY) : GL_READ_ONLY;
        glBindImageTexture(GLuint(image.unit), texture.id(), mip, layered, std::max(layer, 0), access,
                           texture.desc().format);
    }

    for (const BlockInfo& block : interface.storage_blocks) {
        const Buffer* buffer = &graph_.empty_buffer_; // a skipped list: something readable must be there
        const PlanSlot* s = pass_.find(slot_name(block.name));
        if (block.name == "scene_vertices")
            buffer = &scene.vertices();
        else if (block.name == "scene_indices")
            buffer = &scene.indices();
        else if (block.name == "scene_draws")
            buffer = &scene.draws();
        else if (block.name == "scene_materials")
            buffer = &scene.materials();
        else if (block.name == "scene_lights")
            buffer = &scene.lights();
        else if (s && s->resource >= 0)
            buffer = &graph_.allocations_.buffer(s->resource, s->bind.previous);
        check_block_size(block.name, buffer->bytes());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block.binding, buffer->id());
    }
    return *program;
}

static glm::uvec3 groups(glm::ivec3 threads, glm::ivec3 local) {
    return glm::uvec3((glm::max(threads, glm::ivec3(0)) + local - 1) / local);
}

void PassContext::dispatch(const std::string& name, glm::ivec3 threads) {
    Program& program = use(name);
    glm::uvec3 count = groups(threads, program.interface().local_size);
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t limit = driver_limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis);
        if (int64_t(count[axis]) > limit)
            throw Error(fmt::format("{} work groups along {} of '{}'; this driver allows {} "
                                    "(GL_MAX_COMPUTE_WORK_GROUP_COUNT): use a smaller scene or size",
                                    grouped(count[axis]), "xyz"[axis], name, grouped(uint64_t(limit))));
    }
    if (count.x && count.y && count.z) glDispatchCompute(count.x, count.y, count.z);
}

void PassContext::barrier() {
    memory_barrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                   GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                   GL_FRAMEBUFFER_BARRIER_BIT);
}

void PassContext::dispatch_indirect(const std::string& name, const std::string& slot_of_counts, GLintptr offset) {
    use(name);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer(slot_of_counts).id());
    glDispatchComputeIndirect(offset);
}

void PassContext::bind_targets(const Targets& targets) {
    auto tuple_of = [&](const std::string& name) -> std::tuple<int, int, int> {
        if (name.empty()) return {-1, 0, -1};
        const PlanSlot& s = slot(name);
        int mip = index_at(s.bind.mip), layer = index_at(s.bind.layer);
        return {s.resource, mip >= 0 ? mip : targets.mip, layer >= 0 ? layer : targets.layer};
    };
    std::vector<std::tuple<int, int, int>> colours;
    for (const std::string& colour : targets.colours)
        colours.push_back(tuple_of(colour));
    auto depth = tuple_of(targets.depth);
    auto first = colours.empty() ? depth : colours.front();
    bool bare = std::get<0>(first) < 0;
    glm::ivec3 size(targets.size, 1);
    if (!bare) size = mip_size(graph_.allocations_.texture(std::get<0>(first)).desc(), std::get<1>(first));
    glm::ivec2 bare_size = bare ? targets.size : glm::ivec2(0);
    glBindFramebuffer(GL_FRAMEBUFFER, graph_.allocations_.framebuffer(colours, depth, bare_size).id());
    glViewport(0, 0, size.x, size.y);
}

void PassContext::draw_scene(const std::string& name, const Targets& targets, const DrawOptions& options) {
    bind_targets(targets);
    Program& program = use(name);
    const GpuScene& drawn = scene({ScenePart::geometry, ScenePart::textures, ScenePart::materials});
    if (options.which != DrawOptions::Which::dynamic_only) scene({ScenePart::static_draws});
    if (options.which != DrawOptions::Which::static_only) scene({ScenePart::dynamic_draws});
    glBindVertexArray(drawn.vertex_array());
    GLint units[4] = {-1, -1, -1, -1};
    static const char* const names[4] = {"material_base_colour", "material_metallic_roughness", "material_normal",
                                         "material_emission"};
    for (const OpaqueInfo& sampler : program.interface().samplers) {
        for (int i = 0; i < 4; ++i) {
            if (sampler.name == names[i]) units[i] = sampler.unit;
        }
    }
    const auto& draws = drawn.draw_list();
    const auto& materials = drawn.material_list();
    int bound_material = -1;
    bool culling = false, clockwise = options.y_turned;
    glFrontFace(clockwise ? GL_CW : GL_CCW);
    for (size_t i = 0; i < draws.size(); ++i) {
        const GpuDraw& draw = draws[i];
        bool dynamic = draw.flags & GpuDraw::k_dynamic;
        if (options.which == DrawOptions::Which::static_only && dynamic) continue;
        if (options.which == DrawOptions::Which::dynamic_only && !dynamic) continue;
        if (options.keep && !options.keep(int(i))) continue;
        // The determinant of a node's transform turns the winding of its triangles (glTF 2.0 §3.7.2.1).
        if (bool turned = bool(draw.flags & GpuDraw::k_mirrored) != options.y_turned; turned != clockwise) {
            clockwise = turned;
            glFrontFace(clockwise ? GL_CW : GL_CCW);
        }
        int material = int(draw.material);
        if (material != bound_material) {
            bound_material = material;
            const GpuScene::Bound bound[4] = {drawn.base_colour(material), drawn.metallic_roughness(material),
                                              drawn.normal(material), drawn.emission(material)};
            for (int t = 0; t < 4; ++t) {
                if (units[t] < 0) continue;
                glBindTextureUnit(GLuint(units[t]), bound[t].texture);
                glBindSampler(GLuint(units[t]), bound[t].sampler);
            }
            bool cull = options.cull_back_faces && !materials[size_t(material)].double_sided;
            if (cull != culling) (cull ? glEnable : glDisable)(GL_CULL_FACE);
            culling = cull;
        }
        glDrawElementsInstancedBaseInstance(
            GL_TRIANGLES, GLsizei(draw.index_count), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(uintptr_t(draw.first_index) * sizeof(uint32_t)), options.instances,
            GLuint(i));
    }
    if (culling) glDisable(GL_CULL_FACE);
}

void PassContext::draw_fullscreen(const std::string& program, const Targets& targets) {
    draw_arrays(program, targets, GL_TRIANGLES, 3);
}

void PassContext::draw_arrays(const std::string& name, const Targets& targets, GLenum mode, int count, int instances) {
    bind_targets(targets);
    use(name);
    glBindVertexArray(graph_.empty_vertex_array_.id());
    glDrawArraysInstanced(mode, 0, count, instances);
}

void PassContext::draw_arrays_indirect(const std::string& name, const Targets& targets, GLenum mode,
                                       const std::string& slot_of_counts, GLintptr offset) {
    bind_targets(targets);
    use(name);
    glBindVertexArray(graph_.empty_vertex_array_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer(slot_of_counts).id());
    glDrawArraysIndirect(mode, reinterpret_cast<const void*>(offset));
}

} // namespace bounce
