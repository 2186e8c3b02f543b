#include "gpu/capabilities.h"

#include "core/error.h"
#include "core/log.h"
#include "core/text.h"
#include "gpu/call_watch.h"
#include "gpu/shader_cache.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace bounce {

namespace {
struct NeededLimit {
    GLenum name;
    const char* text;
    long long least; ///< the minimum of the OpenGL 4.6 specification, which the published graphs fit
};
const NeededLimit k_limits[] = {
    {GL_MAX_TEXTURE_SIZE, "GL_MAX_TEXTURE_SIZE", 16384},
    {GL_MAX_3D_TEXTURE_SIZE, "GL_MAX_3D_TEXTURE_SIZE", 2048},
    {GL_MAX_ARRAY_TEXTURE_LAYERS, "GL_MAX_ARRAY_TEXTURE_LAYERS", 2048},
    {GL_MAX_TEXTURE_IMAGE_UNITS, "GL_MAX_TEXTURE_IMAGE_UNITS", 16},
    {GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, "GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS", 16},
    {GL_MAX_IMAGE_UNITS, "GL_MAX_IMAGE_UNITS", 8},
    {GL_MAX_COMPUTE_IMAGE_UNIFORMS, "GL_MAX_COMPUTE_IMAGE_UNIFORMS", 8},
    {GL_MAX_FRAGMENT_IMAGE_UNIFORMS, "GL_MAX_FRAGMENT_IMAGE_UNIFORMS", 8},
    {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, "GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS", 8},
    {GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, "GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS", 8},
    {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE", 1 << 27},
    {GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, "GL_MAX_COMPUTE_SHARED_MEMORY_SIZE", 32768},
    {GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, "GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS", 1024},
    {GL_MAX_COLOR_ATTACHMENTS, "GL_MAX_COLOR_ATTACHMENTS", 8},
    {GL_MAX_DRAW_BUFFERS, "GL_MAX_DRAW_BUFFERS", 8},
    {GL_MAX_VIEWPORTS, "GL_MAX_VIEWPORTS", 16},
    {GL_MAX_UNIFORM_BLOCK_SIZE, "GL_MAX_UNIFORM_BLOCK_SIZE", 16384},
};

std::atomic<uint64_t> g_high_severity{0};

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

void GLAD_API_PTR on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei, const GLchar* message,
                             const void*) {
    if (source == GL_DEBUG_SOURCE_APPLICATION || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    // A shader that does not compile is reported by its program, with file and line.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR) {
        ++g_high_severity;
        spdlog::error("OpenGL ({}): {}", id, message);
    } else if (severity == GL_DEBUG_SEVERITY_MEDIUM && type != GL_DEBUG_TYPE_PERFORMANCE) {
        spdlog::warn("OpenGL ({}): {}", id, message);
    } else {
        spdlog::debug("OpenGL ({}): {}", id, message);
    }
}
} // namespace

void ask_mesa_for_46() {
    ::setenv("MESA_GL_VERSION_OVERRIDE", "4.6", 0);
    ::setenv("MESA_GLSL_VERSION_OVERRIDE", "460", 0);
}

Capabilities start_context() {
    settle_shader_cache();
    if (call_watch_is_wanted())
        watch_calls();
    else
        stop_call_watch();
    start_debug_messages();
    Capabilities capabilities = read_capabilities();
    if (!capabilities.missing.empty()) {
        throw Error("this driver (" + capabilities.renderer + ", " + capabilities.version +
                    ") lacks what Bounce needs: " + join(capabilities.missing, "; "));
    }
    return capabilities;
}

Capabilities read_capabilities() {
    Capabilities caps;
    caps.renderer = text_of(GL_RENDERER);
    caps.vendor = text_of(GL_VENDOR);
    caps.version = text_of(GL_VERSION);
    caps.glsl_version = text_of(GL_SHADING_LANGUAGE_VERSION);

    GLint major = 0, minor = 0, extensions = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 46) caps.missing.push_back(fmt::format("OpenGL 4.6 (this is {}.{})", major, minor));

    std::vector<std::string> names;
    glGetIntegerv(GL_NUM_EXTENSIONS, &extensions);
    for (GLint i = 0; i < extensions; ++i) {
        names.push_back(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))));
    }
    auto has = [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
    // The version may be an override, so what 4.5 and 4.6 brought and Bounce uses is asked for by name.
    for (const char* needed : {"GL_ARB_direct_state_access", "GL_ARB_clip_control", "GL_ARB_shader_draw_parameters",
                               "GL_ARB_texture_view", "GL_ARB_shader_storage_buffer_object", "GL_KHR_debug"}) {
        if (!has(needed)) caps.missing.push_back(std::string("extension ") + needed);
    }
    caps.layer_from_vertex_shader = has("GL_ARB_shader_viewport_layer_array");
    caps.anisotropic_filtering = has("GL_ARB_texture_filter_anisotropic") || has("GL_EXT_texture_filter_anisotropic");

    for (const NeededLimit& needed : k_limits) {
        GLint64 value = 0;
        glGetInteger64v(needed.name, &value);
        caps.limits[needed.text] = value;
        if (value < needed.least) {
            caps.missing.push_back(fmt::format("{} of {} (this driver has {})", needed.text, needed.least, value));
        }
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    return caps;
}

int64_t driver_limit(GLenum name) {
    if (!glGetInteger64v) return std::numeric_limits<int64_t>::max();
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value;
}

std::string describe(const Capabilities& caps) {
    std::string text = fmt::format("renderer: {} ({})\nOpenGL:   {}, GLSL {}\n", caps.renderer, caps.vendor,
                                   caps.version, caps.glsl_version);
    text += "missing:  " + (caps.missing.empty() ? std::string("nothing that Bounce needs") : join(caps.missing, "; "));
    if (!caps.layer_from_vertex_shader) {
        text += "\nabsent:   ARB_shader_viewport_layer_array (a geometry shader chooses the layer instead)";
    }
    return text;
}

void start_debug_messages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, nullptr);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
}

uint64_t high_severity_messages() {
    return g_high_severity;
}

} // namespace bounce
