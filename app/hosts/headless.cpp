#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "app/hosts/headless.h"

#include "core/error.h"
#include "core/log.h"
#include "gpu/shader_cache.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <glad/gl.h>

namespace bounce {

namespace {

template <typename T>
T function(const char* name) {
    return reinterpret_cast<T>(eglGetProcAddress(name));
}

bool has_word(const char* list, const char* word) {
    if (!list) return false;
    size_t length = std::strlen(word);
    for (const char* at = std::strstr(list, word); at; at = std::strstr(at + length, word)) {
        bool starts = at == list || at[-1] == ' ';
        bool ends = at[length] == ' ' || at[length] == '\0';
        if (starts && ends) return true;
    }
    return false;
}

std::vector<EGLDeviceEXT> devices() {
    auto query = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query || !query(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> found(static_cast<size_t>(count));
    query(count, found.data(), &count);
    found.resize(static_cast<size_t>(count));
    return found;
}

HeadlessDevice describe_device(EGLDeviceEXT device, int index) {
    auto query = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    HeadlessDevice out{index, "device", false};
    if (!query) return out;
    const char* extensions = query(device, EGL_EXTENSIONS);
    out.software = has_word(extensions, "EGL_MESA_device_software");
    if (out.software)
        out.name = "software";
    else if (has_word(extensions, "EGL_EXT_device_drm")) {
        if (const char* file = query(device, EGL_DRM_DEVICE_FILE_EXT)) out.name = file;
    }
    return out;
}

} // namespace

struct HeadlessContext::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLDisplay last = EGL_NO_DISPLAY; ///< that was opened

    ~Egl() { close(); }

    void close() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
        eglReleaseThread();
        display = EGL_NO_DISPLAY;
        context = EGL_NO_CONTEXT;
    }

    /// Tries one display; on failure leaves nothing behind and says why.
    std::string open(EGLDisplay candidate) {
        if (candidate == EGL_NO_DISPLAY) return "no display";
        EGLint major = 0, minor = 0;
        if (!eglInitialize(candidate, &major, &minor)) return "eglInitialize failed";
        display = last = candidate;
        eglBindAPI(EGL_OPENGL_API);
        for (bool robust : {true, false}) {
            std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                              EGL_CONTEXT_MINOR_VERSION,       6,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,        EGL_TRUE};
            if (robust) {
                attributes.insert(attributes.end(),
                                  {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                                   EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
            }
            attributes.push_back(EGL_NONE);
            context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
            if (context != EGL_NO_CONTEXT) break;
        }
        if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) &&
            gladLoadGL(eglGetProcAddress)) {
            return {};
        }
        std::string why = context == EGL_NO_CONTEXT ? "no OpenGL 4.6 core context"
                                                    : "the context cannot be made current without a surface";
        close();
        return why;
    }
};

std::vector<HeadlessDevice> list_headless_devices() {
    ask_mesa_for_46();
    std::vector<HeadlessDevice> out;
    int index = 0;
    for (EGLDeviceEXT device : devices())
        out.push_back(describe_device(device, index++));
    return out;
}

HeadlessContext::HeadlessContext(int wanted) : egl_(std::make_unique<Egl>()) {
    ask_mesa_for_46();
    guard_shader_cache();
    auto platform = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    std::vector<EGLDeviceEXT> found = devices();
    std::vector<HeadlessDevice> order = list_headless_devices();
    if (wanted >= int(order.size())) {
        throw Error(fmt::format("there is no device {}; --list-devices shows {}", wanted, order.size()));
    }
    std::string reasons;
    std::stable_sort(order.begin(), order.end(), [](auto& a, auto& b) { return a.software < b.software; });
    bool open = false;
    for (const HeadlessDevice& device : order) {
        if (open || !platform || (wanted >= 0 && device.index != wanted)) continue;
        std::string why = egl_->open(platform(EGL_PLATFORM_DEVICE_EXT, found[size_t(device.index)], nullptr));
        open = why.empty();
        if (!open) reasons += fmt::format("\n  device {} ({}): {}", device.index, device.name, why);
    }
    if (!open && wanted < 0 && platform) {
        std::string why = egl_->open(platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
        open = why.empty();
        if (!open) reasons += "\n  surfaceless: " + why;
    }
    if (!open)
        throw Error("no OpenGL 4.6 context could be made without a window:" +
                    (reasons.empty() ? " EGL has no devices" : reasons));
    capabilities_ = start_context();
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_again() {
    egl_->close();
    if (const std::string why = egl_->open(egl_->last); !why.empty())
        throw Error("no context could be made again: " + why);
    capabilities_ = start_context();
}

} // namespace bounce
