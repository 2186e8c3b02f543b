#pragma once
// What the driver is and has, checked by name at start, and its messages.

#include <cstdint>
#include <glad/gl.h>
#include <map>
#include <string>
#include <vector>

namespace bounce {

struct Capabilities {
    std::string renderer, vendor, version, glsl_version;
    std::vector<std::string> missing;      ///< needed limits and features that are not there, one line each
    bool layer_from_vertex_shader = false; ///< ARB_shader_viewport_layer_array
    bool anisotropic_filtering = false;
    std::map<std::string, long long> limits; ///< the limits that graphs are checked against (driver_limits.h)
};

/// Mesa's software drivers implement what 4.6 needs but report 4.5: asks them for 4.6, unless the user has set the
/// overrides. Call before the first EGL or GLFW call.
void ask_mesa_for_46();

/// Reads the current context. Does not throw; `missing` says what is not there.
Capabilities read_capabilities();
/// Three or four lines for the start of the log.
std::string describe(const Capabilities& capabilities);

/// What a host does once its context is current: messages to the log, capabilities, and an Error that names what is
/// missing.
Capabilities start_context();

/// Sends KHR_debug messages of the current context to the log and counts those of high severity (and every GL error).
void start_debug_messages();
uint64_t high_severity_messages();

/// A KHR_debug group, for graphics debuggers.
class DebugGroup {
  public:
    explicit DebugGroup(const std::string& name) { glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name.c_str()); }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

} // namespace bounce
