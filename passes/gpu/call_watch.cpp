#include "gpu/call_watch.h"

#include "core/log.h"
#include "gpu/call_state.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <optional>

// Each watched function: the driver's own is kept as real_NAME, and a lambda takes its place in glad's table.
// clang-format off
#define BOUNCE_WATCHED(WATCH) \
    WATCH(UseProgram) WATCH(DeleteProgram) WATCH(ShaderSource) WATCH(DeleteShader) WATCH(AttachShader) \
    WATCH(LinkProgram) \
    WATCH(BindTextureUnit) WATCH(BindImageTexture) WATCH(BindBufferBase) WATCH(BindBufferRange) WATCH(BindBuffer) \
    WATCH(BindFramebuffer) WATCH(BindVertexArray) WATCH(VertexArrayVertexBuffer) WATCH(VertexArrayElementBuffer) \
    WATCH(CreateTextures) WATCH(TextureStorage2D) WATCH(TextureStorage3D) WATCH(TextureView) WATCH(DeleteTextures) \
    WATCH(CreateBuffers) WATCH(DeleteBuffers) WATCH(NamedFramebufferTexture) WATCH(NamedFramebufferTextureLayer) \
    WATCH(DeleteFramebuffers) WATCH(ObjectLabel) WATCH(PushDebugGroup) WATCH(PopDebugGroup) WATCH(MemoryBarrier) \
    WATCH(DispatchCompute) WATCH(DispatchComputeIndirect) WATCH(DrawArraysInstanced) WATCH(DrawArraysIndirect) \
    WATCH(DrawElementsInstancedBaseInstance) WATCH(CopyImageSubData) WATCH(CopyNamedBufferSubData) \
    WATCH(ClearTexImage) WATCH(ClearNamedBufferData) WATCH(GetTextureImage) WATCH(GetTextureSubImage) \
    WATCH(GetNamedBufferSubData) WATCH(NamedBufferSubData) WATCH(TextureSubImage2D) WATCH(TextureSubImage3D) \
    WATCH(MapNamedBufferRange)
// clang-format on

namespace bounce {

namespace {

#define BOUNCE_KEEP(NAME) decltype(glad_gl##NAME) real_##NAME = nullptr;
BOUNCE_WATCHED(BOUNCE_KEEP)
#undef BOUNCE_KEEP

struct Watch {
    CallState state;
    HazardCheck check;
    int commands = 0;                 ///< in the innermost debug group
    std::vector<MemoryUse> last_draw; ///< empty after anything else
    GLuint last_program = 0;          ///< of that draw
    int overlooked = -1;
};
std::unique_ptr<Watch> g_watch;
PFNGLUSEPROGRAMPROC g_ours = nullptr; ///< what stands in the table for glUseProgram while calls are watched

std::string place(const char* what) {
    const CallState& state = g_watch->state;
    const std::string pass = state.groups.empty() ? "" : fmt::format("pass '{}', ", state.groups.back());
    return fmt::format("{}command {} ({})", pass, g_watch->commands, what);
}

void run(const std::string& what, std::vector<MemoryUse> uses) {
    ++g_watch->commands;
    g_watch->check.command({place(what.c_str()), std::move(uses)});
}

std::string program_name() {
    return g_watch->state.label(GL_PROGRAM, g_watch->state.program, "program");
}

void dispatch(GLenum indirect_target, int64_t offset) {
    std::vector<MemoryUse> uses;
    std::vector<std::string> problems;
    g_watch->state.add_program(uses, problems);
    if (indirect_target) g_watch->state.add_indirect(uses, indirect_target, offset, 12);
    g_watch->last_draw.clear();
    run("dispatch of " + program_name(), std::move(uses));
    for (const std::string& problem : problems)
        g_watch->check.report(place("dispatch") + ": " + problem);
}

/// Draws in a row that store to the same memory are one: what orders the invocations of one orders theirs. Of such a
/// draw, what the one before did not reach: the textures of another material.
std::vector<MemoryUse> beyond_last_draw(const std::vector<MemoryUse>& uses) {
    auto stores = [](std::vector<MemoryUse> of) {
        std::erase_if(of, [](const MemoryUse& use) { return !use.stores(); });
        return of;
    };
    const std::vector<MemoryUse>& last = g_watch->last_draw;
    std::vector<MemoryUse> beyond = uses;
    if (g_watch->last_program == g_watch->state.program && stores(uses) == stores(last))
        std::erase_if(beyond, [&](const MemoryUse& use) {
            const bool target = use.writes && !use.stores(); // which a texture of this draw may be
            return !target && std::find(last.begin(), last.end(), use) != last.end();
        });
    return beyond;
}

void draw(bool indices, GLenum indirect_target, int64_t offset) {
    std::vector<MemoryUse> uses;
    std::vector<std::string> problems;
    g_watch->state.add_program(uses, problems);
    g_watch->state.add_framebuffer(uses);
    g_watch->state.add_vertices(uses, indices);
    if (indirect_target) g_watch->state.add_indirect(uses, indirect_target, offset, 16);
    run("draw with " + program_name(), beyond_last_draw(uses));
    g_watch->last_draw = std::move(uses);
    g_watch->last_program = g_watch->state.program;
    for (const std::string& problem : problems)
        g_watch->check.report(place("draw") + ": " + problem);
}

void transfer_texture(const char* what, GLuint texture, GLint level, int layer, int layers, bool writes) {
    MemoryRange range = g_watch->state.texture_range(texture, level, 1, layer, layers);
    g_watch->last_draw.clear();
    run(what, {{range, MemoryRoute::texture_transfer, !writes, writes, ""}});
}

void transfer_buffer(const char* what, GLuint buffer, int64_t offset, int64_t bytes, bool writes) {
    MemoryRange range = CallState::buffer_range(buffer, offset, bytes < 0 ? -1 : offset + bytes);
    g_watch->last_draw.clear();
    run(what, {{range, MemoryRoute::buffer_transfer, !writes, writes, ""}});
}

void new_texture(GLuint texture, int mips, int layers) {
    g_watch->state.textures[texture] = {texture, 0, mips, 0, layers};
}

void watch_programs() {
    glad_glUseProgram = [](GLuint program) {
        g_watch->state.program = program;
        real_UseProgram(program);
    };
    glad_glDeleteProgram = [](GLuint program) {
        g_watch->state.program_is_gone(program);
        real_DeleteProgram(program);
    };
    glad_glShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
        std::string& text = g_watch->state.shader_texts[shader];
        text.clear();
        for (GLsizei i = 0; i < count; ++i)
            text += lengths && lengths[i] >= 0 ? std::string(texts[i], size_t(lengths[i])) : std::string(texts[i]);
        real_ShaderSource(shader, count, texts, lengths);
    };
    glad_glDeleteShader = [](GLuint shader) { // programs are linked by then
        g_watch->state.shader_texts.erase(shader);
        real_DeleteShader(shader);
    };
    glad_glAttachShader = [](GLuint program, GLuint shader) {
        g_watch->state.attached[program].push_back(shader);
        real_AttachShader(program, shader);
    };
    glad_glLinkProgram = [](GLuint program) {
        real_LinkProgram(program);
        g_watch->state.linked(program);
    };
}

void watch_bindings() {
    glad_glBindTextureUnit = [](GLuint unit, GLuint texture) {
        g_watch->state.sampled[unit] = texture;
        real_BindTextureUnit(unit, texture);
    };
    glad_glBindImageTexture = [](GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer,
                                 GLenum access, GLenum format) {
        g_watch->state.images[unit] = {texture, level, layered != GL_FALSE, layer, format};
        real_BindImageTexture(unit, texture, level, layered, layer, access, format);
    };
    glad_glBindBufferBase = [](GLenum target, GLuint index, GLuint buffer) {
        auto& units = target == GL_UNIFORM_BUFFER ? g_watch->state.uniforms : g_watch->state.storage;
        if (target == GL_UNIFORM_BUFFER || target == GL_SHADER_STORAGE_BUFFER) units[index] = {buffer, 0, -1};
        real_BindBufferBase(target, index, buffer);
    };
    glad_glBindBufferRange = [](GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr bytes) {
        auto& units = target == GL_UNIFORM_BUFFER ? g_watch->state.uniforms : g_watch->state.storage;
        if (target == GL_UNIFORM_BUFFER || target == GL_SHADER_STORAGE_BUFFER)
            units[index] = {buffer, offset, offset + bytes};
        real_BindBufferRange(target, index, buffer, offset, bytes);
    };
    glad_glBindBuffer = [](GLenum target, GLuint buffer) {
        g_watch->state.indirect[target] = buffer;
        real_BindBuffer(target, buffer);
    };
    glad_glBindFramebuffer = [](GLenum target, GLuint framebuffer) {
        if (target != GL_READ_FRAMEBUFFER) g_watch->state.framebuffer = framebuffer;
        real_BindFramebuffer(target, framebuffer);
    };
    glad_glBindVertexArray = [](GLuint array) {
        g_watch->state.vertex_array = array;
        real_BindVertexArray(array);
    };
    glad_glVertexArrayVertexBuffer = [](GLuint array, GLuint binding, GLuint buffer, GLintptr offset, GLsizei stride) {
        g_watch->state.vertex_arrays[array].buffers[binding] = buffer;
        real_VertexArrayVertexBuffer(array, binding, buffer, offset, stride);
    };
    glad_glVertexArrayElementBuffer = [](GLuint array, GLuint buffer) {
        g_watch->state.vertex_arrays[array].indices = buffer;
        real_VertexArrayElementBuffer(array, buffer);
    };
}

void watch_objects() {
    glad_glCreateTextures = [](GLenum target, GLsizei count, GLuint* textures) {
        real_CreateTextures(target, count, textures);
        for (GLsizei i = 0; i < count; ++i)
            g_watch->check.forget(textures[i], false);
    };
    glad_glTextureStorage2D = [](GLuint texture, GLsizei mips, GLenum format, GLsizei width, GLsizei height) {
        new_texture(texture, mips, 1);
        real_TextureStorage2D(texture, mips, format, width, height);
    };
    glad_glTextureStorage3D = [](GLuint texture, GLsizei mips, GLenum format, GLsizei width, GLsizei height,
                                 GLsizei depth) {
        new_texture(texture, mips, depth);
        real_TextureStorage3D(texture, mips, format, width, height, depth);
    };
    glad_glTextureView = [](GLuint view, GLenum target, GLuint origin, GLenum format, GLuint first_mip, GLuint mips,
                            GLuint first_layer, GLuint layers) {
        MemoryRange part = g_watch->state.texture_range(origin, int(first_mip), int(mips), 0, 1 << 30);
        const bool volume = target == GL_TEXTURE_3D; // whose view has all of its slices
        const int first = int(part.begin) + (volume ? 0 : int(first_layer));
        g_watch->state.textures[view] = {part.object, part.first_mip, part.end_mip - part.first_mip, first,
                                         volume ? int(part.end - part.begin) : int(layers)};
        real_TextureView(view, target, origin, format, first_mip, mips, first_layer, layers);
    };
    glad_glDeleteTextures = [](GLsizei count, const GLuint* textures) {
        for (GLsizei i = 0; i < count; ++i) {
            g_watch->check.forget(textures[i], false);
            g_watch->state.textures.erase(textures[i]);
            g_watch->state.labels.erase({GL_TEXTURE, textures[i]});
        }
        real_DeleteTextures(count, textures);
    };
    glad_glCreateBuffers = [](GLsizei count, GLuint* buffers) {
        real_CreateBuffers(count, buffers);
        for (GLsizei i = 0; i < count; ++i)
            g_watch->check.forget(buffers[i], true);
    };
    glad_glDeleteBuffers = [](GLsizei count, const GLuint* buffers) {
        for (GLsizei i = 0; i < count; ++i) {
            g_watch->check.forget(buffers[i], true);
            g_watch->state.labels.erase({GL_BUFFER, buffers[i]});
        }
        real_DeleteBuffers(count, buffers);
    };
    glad_glNamedFramebufferTexture = [](GLuint framebuffer, GLenum attachment, GLuint texture, GLint level) {
        g_watch->state.framebuffers[framebuffer][attachment] = {texture, level, -1};
        real_NamedFramebufferTexture(framebuffer, attachment, texture, level);
    };
    glad_glNamedFramebufferTextureLayer = [](GLuint framebuffer, GLenum attachment, GLuint texture, GLint level,
                                             GLint layer) {
        g_watch->state.framebuffers[framebuffer][attachment] = {texture, level, layer};
        real_NamedFramebufferTextureLayer(framebuffer, attachment, texture, level, layer);
    };
    glad_glDeleteFramebuffers = [](GLsizei count, const GLuint* framebuffers) {
        for (GLsizei i = 0; i < count; ++i)
            g_watch->state.framebuffers.erase(framebuffers[i]);
        real_DeleteFramebuffers(count, framebuffers);
    };
    glad_glObjectLabel = [](GLenum kind, GLuint name, GLsizei length, const GLchar* text) {
        if (text) g_watch->state.labels[{kind, name}] = length < 0 ? text : std::string(text, size_t(length));
        real_ObjectLabel(kind, name, length, text);
    };
    glad_glPushDebugGroup = [](GLenum source, GLuint id, GLsizei length, const GLchar* text) {
        g_watch->state.groups.push_back(length < 0 ? text : std::string(text, size_t(length)));
        g_watch->commands = 0;
        real_PushDebugGroup(source, id, length, text);
    };
    glad_glPopDebugGroup = [] {
        if (!g_watch->state.groups.empty()) g_watch->state.groups.pop_back();
        real_PopDebugGroup();
    };
}

void watch_commands() {
    glad_glMemoryBarrier = [](GLbitfield bits) {
        const bool counts = g_watch->overlooked != 0;
        if (g_watch->overlooked >= 0) --g_watch->overlooked;
        g_watch->last_draw.clear();
        if (counts) g_watch->check.barrier(bits, place("barrier"));
        real_MemoryBarrier(bits);
    };
    glad_glDispatchCompute = [](GLuint x, GLuint y, GLuint z) {
        dispatch(0, 0);
        real_DispatchCompute(x, y, z);
    };
    glad_glDispatchComputeIndirect = [](GLintptr offset) {
        dispatch(GL_DISPATCH_INDIRECT_BUFFER, offset);
        real_DispatchComputeIndirect(offset);
    };
    glad_glDrawArraysInstanced = [](GLenum mode, GLint first, GLsizei count, GLsizei instances) {
        draw(false, 0, 0);
        real_DrawArraysInstanced(mode, first, count, instances);
    };
    glad_glDrawArraysIndirect = [](GLenum mode, const void* offset) {
        draw(false, GL_DRAW_INDIRECT_BUFFER, int64_t(reinterpret_cast<intptr_t>(offset)));
        real_DrawArraysIndirect(mode, offset);
    };
    glad_glDrawElementsInstancedBaseInstance = [](GLenum mode, GLsizei count, GLenum type, const void* indices,
                                                  GLsizei instances, GLuint base) {
        draw(true, 0, 0);
        real_DrawElementsInstancedBaseInstance(mode, count, type, indices, instances, base);
    };
}

void watch_transfers() {
    glad_glCopyImageSubData = [](GLuint from, GLenum from_target, GLint from_level, GLint fx, GLint fy, GLint fz,
                                 GLuint to, GLenum to_target, GLint to_level, GLint tx, GLint ty, GLint tz, GLsizei w,
                                 GLsizei h, GLsizei d) {
        transfer_texture("copy", from, from_level, fz, d, false);
        transfer_texture("copy", to, to_level, tz, d, true);
        real_CopyImageSubData(from, from_target, from_level, fx, fy, fz, to, to_target, to_level, tx, ty, tz, w, h, d);
    };
    glad_glCopyNamedBufferSubData = [](GLuint from, GLuint to, GLintptr at, GLintptr to_at, GLsizeiptr bytes) {
        transfer_buffer("copy", from, at, bytes, false);
        transfer_buffer("copy", to, to_at, bytes, true);
        real_CopyNamedBufferSubData(from, to, at, to_at, bytes);
    };
    glad_glClearTexImage = [](GLuint texture, GLint level, GLenum format, GLenum type, const void* value) {
        transfer_texture("clear", texture, level, 0, 1 << 30, true);
        real_ClearTexImage(texture, level, format, type, value);
    };
    glad_glClearNamedBufferData = [](GLuint buffer, GLenum internal, GLenum format, GLenum type, const void* value) {
        transfer_buffer("clear", buffer, 0, -1, true);
        real_ClearNamedBufferData(buffer, internal, format, type, value);
    };
    glad_glGetTextureImage = [](GLuint texture, GLint level, GLenum format, GLenum type, GLsizei bytes, void* out) {
        transfer_texture("read-back", texture, level, 0, 1 << 30, false);
        real_GetTextureImage(texture, level, format, type, bytes, out);
    };
    glad_glGetTextureSubImage = [](GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei w, GLsizei h,
                                   GLsizei d, GLenum format, GLenum type, GLsizei bytes, void* out) {
        transfer_texture("read-back", texture, level, z, d, false);
        real_GetTextureSubImage(texture, level, x, y, z, w, h, d, format, type, bytes, out);
    };
    glad_glGetNamedBufferSubData = [](GLuint buffer, GLintptr offset, GLsizeiptr bytes, void* out) {
        transfer_buffer("read-back", buffer, offset, bytes, false);
        real_GetNamedBufferSubData(buffer, offset, bytes, out);
    };
    glad_glNamedBufferSubData = [](GLuint buffer, GLintptr offset, GLsizeiptr bytes, const void* data) {
        transfer_buffer("upload", buffer, offset, bytes, true);
        real_NamedBufferSubData(buffer, offset, bytes, data);
    };
    glad_glTextureSubImage2D = [](GLuint texture, GLint level, GLint x, GLint y, GLsizei w, GLsizei h, GLenum format,
                                  GLenum type, const void* data) {
        transfer_texture("upload", texture, level, 0, 1, true);
        real_TextureSubImage2D(texture, level, x, y, w, h, format, type, data);
    };
    glad_glTextureSubImage3D = [](GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei w, GLsizei h,
                                  GLsizei d, GLenum format, GLenum type, const void* data) {
        transfer_texture("upload", texture, level, z, d, true);
        real_TextureSubImage3D(texture, level, x, y, z, w, h, d, format, type, data);
    };
    glad_glMapNamedBufferRange = [](GLuint buffer, GLintptr offset, GLsizeiptr bytes, GLbitfield access) -> void* {
        transfer_buffer("mapping", buffer, offset, bytes, access & GL_MAP_WRITE_BIT);
        return real_MapNamedBufferRange(buffer, offset, bytes, access);
    };
}

} // namespace

void watch_calls() {
    g_watch = std::make_unique<Watch>();
    g_watch->check.describe = [](const MemoryRange& range) { return g_watch->state.describe(range); };
    g_watch->check.on_hazard = [](const std::string& hazard) { spdlog::error("hazard: {}", hazard); };
    // Where the functions were not loaded anew, ours are still in the table.
    if (g_ours && glad_glUseProgram == g_ours) return;
#define BOUNCE_KEEP(NAME) real_##NAME = glad_gl##NAME;
    BOUNCE_WATCHED(BOUNCE_KEEP)
#undef BOUNCE_KEEP
    watch_programs();
    watch_bindings();
    watch_objects();
    watch_commands();
    watch_transfers();
    g_ours = glad_glUseProgram;
}

void stop_call_watch() {
    if (g_watch && glad_glUseProgram == g_ours) {
#define BOUNCE_GIVE_BACK(NAME) glad_gl##NAME = real_##NAME;
        BOUNCE_WATCHED(BOUNCE_GIVE_BACK)
#undef BOUNCE_GIVE_BACK
    }
    g_watch.reset();
}

static std::optional<bool> g_wanted;

void want_call_watch(bool wanted) {
    g_wanted = wanted;
}

bool call_watch_is_wanted() {
    const char* asked = std::getenv("BOUNCE_CHECK_HAZARDS");
    return g_wanted.value_or(asked && *asked);
}

bool calls_are_watched() {
    return g_watch != nullptr;
}

HazardCheck& hazard_check() {
    return g_watch->check;
}

void overlook_barrier(int n) {
    g_watch->overlooked = n;
}

} // namespace bounce
