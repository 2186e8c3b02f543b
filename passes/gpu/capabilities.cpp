#include "gpu/capabilities.h"

#include "core/error.h"
#include "core/log.h"
#include "core/text.h"
#include "gpu/call_watch.h"
#include "gpu/context_loss.h"
#include "gpu/device_memory.h"
#include "gpu/driver_limits.h"
#include "gpu/shader_cache.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fmt/format.h>

namespace bounce {

namespace {
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
    forget_driver();
    forget_reset();
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
    caps.layer_from_vertex_shader = driver_has("GL_ARB_shader_viewport_layer_array");
    caps.anisotropic_filtering = has("GL_ARB_texture_filter_anisotropic") || has("GL_EXT_texture_filter_anisotropic");

    for (const DriverLimit& limit : driver_limits()) {
        caps.limits[limit.text] = driver_limit(limit.name);
        const int64_t value = true_limit(limit.name);
        if (limit.is_needed && value < limit.minimum)
            caps.missing.push_back(fmt::format("{} of {} (this driver has {})", limit.text, limit.minimum, value));
    }
    drop_errors();
    return caps;
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
