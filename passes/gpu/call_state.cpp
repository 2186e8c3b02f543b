#include "gpu/call_state.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace bounce {

static std::string resource_name(GLuint program, GLenum kind, GLuint index) {
    char text[512] = "";
    GLsizei length = 0;
    glGetProgramResourceName(program, kind, index, sizeof text, &length, text);
    std::string name(text, size_t(length));
    if (name.ends_with("[0]")) name.resize(name.size() - 3);
    return name;
}

static std::vector<GLint> properties(GLuint program, GLenum kind, GLuint index, std::vector<GLenum> wanted) {
    std::vector<GLint> values(wanted.size());
    glGetProgramResourceiv(program, kind, index, GLsizei(wanted.size()), wanted.data(), GLsizei(values.size()), nullptr,
                           values.data());
    return values;
}

static GLuint active(GLuint program, GLenum kind) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    return GLuint(count);
}

/// Types of samplers lie in several ranges; what is neither an image nor a plain number, vector or matrix is one.
static bool is_sampler(GLint type) {
    return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_RECT_SHADOW) ||
           (type >= GL_SAMPLER_1D_ARRAY && type <= GL_SAMPLER_CUBE_SHADOW) ||
           (type >= GL_INT_SAMPLER_1D && type <= GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
           (type >= GL_SAMPLER_CUBE_MAP_ARRAY && type <= GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY);
}

std::vector<CallState::Binding> CallState::bindings_of(GLuint which,
                                                       const std::map<std::string, ShaderMemory>& declared) {
    std::vector<Binding> bindings;
    auto memory_of = [&](const std::string& name) {
        auto found = declared.find(name);
        return found == declared.end() ? ShaderMemory{} : found->second;
    };
    for (GLuint i = 0; i < active(which, GL_UNIFORM); ++i) {
        const auto values = properties(which, GL_UNIFORM, i, {GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE});
        const bool image = values[0] >= GL_IMAGE_1D && values[0] <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
        if (!image && !is_sampler(values[0])) continue;
        GLint unit = 0;
        glGetUniformiv(which, values[1], &unit); // of arrays: the program sets their units one after another
        const std::string name = resource_name(which, GL_UNIFORM, i);
        bindings.push_back({name, image ? MemoryRoute::image : MemoryRoute::sampler, GLuint(unit),
                            GLuint(std::max(values[2], 1)), image ? memory_of(name) : ShaderMemory{true, false}});
    }
    for (GLuint i = 0; i < active(which, GL_SHADER_STORAGE_BLOCK); ++i) {
        const auto values = properties(which, GL_SHADER_STORAGE_BLOCK, i, {GL_BUFFER_BINDING});
        const std::string name = resource_name(which, GL_SHADER_STORAGE_BLOCK, i);
        bindings.push_back({name, MemoryRoute::storage, GLuint(values[0]), 1, memory_of(name)});
    }
    for (GLuint i = 0; i < active(which, GL_UNIFORM_BLOCK); ++i) {
        const auto values = properties(which, GL_UNIFORM_BLOCK, i, {GL_BUFFER_BINDING});
        bindings.push_back({resource_name(which, GL_UNIFORM_BLOCK, i), MemoryRoute::uniform, GLuint(values[0]), 1,
                            ShaderMemory{true, false}});
    }
    return bindings;
}

void CallState::linked(GLuint which) {
    Program& linked = programs_[which];
    linked = {};
    for (GLuint shader : attached[which])
        for (const auto& [name, memory] : read_shader_memory(shader_texts[shader])) {
            auto [known, fresh] = linked.declared.emplace(name, memory);
            known->second.reads |= memory.reads;
            known->second.writes |= memory.writes;
        }
    attached.erase(which);
}

MemoryRange CallState::texture_range(GLuint texture, int level, int levels, int layer, int layers) const {
    auto found = textures.find(texture);
    if (found == textures.end()) return {texture, false, level, level + levels, layer, layer + layers};
    const Texture& known = found->second;
    const int end_mip = std::min(level + levels, known.mips), end_layer = std::min(layer + layers, known.layers);
    return {known.origin,
            false,
            known.first_mip + level,
            known.first_mip + end_mip,
            known.first_layer + layer,
            known.first_layer + end_layer};
}

MemoryRange CallState::whole_texture(GLuint texture) const {
    constexpr int all = std::numeric_limits<int>::max() / 2;
    return texture_range(texture, 0, all, 0, all);
}

MemoryRange CallState::buffer_range(GLuint buffer, int64_t begin, int64_t end) {
    return {buffer, true, 0, 1, begin, end < 0 ? std::numeric_limits<int64_t>::max() : end};
}

void CallState::add_program(std::vector<MemoryUse>& uses, std::vector<std::string>& problems) {
    Program& used = programs_[program];
    if (!used.asked) {
        used.bindings = bindings_of(program, used.declared);
        used.asked = true;
    }
    for (const Binding& binding : used.bindings) {
        const ShaderMemory& memory = binding.memory;
        for (GLuint i = 0; i < binding.count; ++i) {
            MemoryUse use{{}, binding.route, memory.reads, memory.writes, binding.name};
            if (binding.route == MemoryRoute::sampler) {
                auto bound = sampled.find(binding.unit + i);
                if (bound == sampled.end() || !bound->second) continue;
                use.range = whole_texture(bound->second);
            } else if (binding.route == MemoryRoute::image) {
                auto bound = images.find(binding.unit + i);
                if (bound == images.end() || !bound->second.texture) continue;
                const ImageUnit& unit = bound->second;
                const MemoryRange whole = whole_texture(unit.texture);
                use.range = texture_range(unit.texture, unit.level, 1, unit.layered ? 0 : unit.layer,
                                          unit.layered ? int(whole.end - whole.begin) : 1);
                if (memory.format && unit.format != memory.format)
                    problems.push_back(fmt::format("image '{}' of {} is bound to another format than its shader states",
                                                   binding.name, describe(use.range)));
            } else {
                const auto& units = binding.route == MemoryRoute::storage ? storage : uniforms;
                auto bound = units.find(binding.unit);
                if (bound == units.end() || !bound->second.buffer) continue;
                use.range = buffer_range(bound->second.buffer, bound->second.begin, bound->second.end);
            }
            uses.push_back(std::move(use));
        }
    }
}

void CallState::add_framebuffer(std::vector<MemoryUse>& uses) const {
    auto found = framebuffers.find(framebuffer);
    if (found == framebuffers.end()) return;
    for (const auto& [attachment, target] : found->second) {
        const MemoryRange whole = whole_texture(target.texture);
        MemoryUse use{{}, MemoryRoute::framebuffer, true, true, ""};
        use.range = texture_range(target.texture, target.level, 1, std::max(target.layer, 0),
                                  target.layer >= 0 ? 1 : int(whole.end - whole.begin));
        uses.push_back(use);
    }
}

void CallState::add_vertices(std::vector<MemoryUse>& uses, bool indices) const {
    auto found = vertex_arrays.find(vertex_array);
    if (found == vertex_arrays.end()) return;
    for (const auto& [binding, buffer] : found->second.buffers)
        if (buffer) uses.push_back({buffer_range(buffer, 0, -1), MemoryRoute::vertices, true, false, ""});
    if (indices && found->second.indices)
        uses.push_back({buffer_range(found->second.indices, 0, -1), MemoryRoute::indices, true, false, ""});
}

void CallState::add_indirect(std::vector<MemoryUse>& uses, GLenum target, int64_t offset, int64_t bytes) const {
    auto found = indirect.find(target);
    if (found == indirect.end() || !found->second) return;
    uses.push_back({buffer_range(found->second, offset, offset + bytes), MemoryRoute::indirect, true, false, ""});
}

std::string CallState::label(GLenum kind, GLuint name, const char* otherwise) const {
    auto found = labels.find({kind, name});
    return found == labels.end() ? fmt::format("{} {}", otherwise, name) : "'" + found->second + "'";
}

std::string CallState::describe(const MemoryRange& range) const {
    if (range.is_buffer) return label(GL_BUFFER, range.object, "buffer");
    std::string text = label(GL_TEXTURE, range.object, "texture");
    auto known = textures.find(range.object);
    if (known == textures.end()) return text;
    if (known->second.mips > 1 && range.end_mip - range.first_mip == 1) text += fmt::format(" mip {}", range.first_mip);
    if (known->second.layers > 1 && range.end - range.begin == 1) text += fmt::format(" layer {}", range.begin);
    return text;
}

} // namespace bounce
