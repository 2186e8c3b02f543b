#include "app/hosts/window.h"

#include "app/hosts/input_queue.h"
#include "core/error.h"
#include "core/log.h"
#include "gpu/shader_cache.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cctype>
#include <fmt/format.h>
#include <imgui.h>
#include <map>

namespace bounce {

struct Window::Native {
    GLFWwindow* handle = nullptr;
    WindowOptions options;
    bool active = true;
    bool scale_changed = false;
    InputQueue input;
    std::vector<KeyPress> keys;
    std::vector<std::string> dropped;
    bool fullscreen = false;
    glm::ivec2 windowed_position{0}, windowed_size{1280, 720};
    glm::ivec2 again_size{1280, 720}; ///< while the window is being made again
    bool again_maximized = false, again_fullscreen = false;
};

namespace {

std::string& last_error() {
    static std::string text;
    return text;
}

void on_error(int, const char* text) {
    last_error() = text;
    spdlog::debug("GLFW: {}", text);
}

Window::Native& native_of(GLFWwindow* handle) {
    return *static_cast<Window::Native*>(glfwGetWindowUserPointer(handle));
}

/// What a key is called in the keys panel; empty for those that have no command.
std::string key_name(int key, int scancode) {
    static const std::map<int, std::string> named = {
        {GLFW_KEY_SPACE, "Space"},       {GLFW_KEY_HOME, "Home"},     {GLFW_KEY_END, "End"},
        {GLFW_KEY_ESCAPE, "Escape"},     {GLFW_KEY_TAB, "Tab"},       {GLFW_KEY_ENTER, "Enter"},
        {GLFW_KEY_LEFT, "Left"},         {GLFW_KEY_RIGHT, "Right"},   {GLFW_KEY_UP, "Up"},
        {GLFW_KEY_DOWN, "Down"},         {GLFW_KEY_DELETE, "Delete"}, {GLFW_KEY_PAGE_UP, "PageUp"},
        {GLFW_KEY_PAGE_DOWN, "PageDown"}};
    if (auto found = named.find(key); found != named.end()) return found->second;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
    // Digits by their place: on some keyboards they need Shift.
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return std::to_string(key - GLFW_KEY_0);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::to_string(key - GLFW_KEY_KP_0);
    const char* label = glfwGetKeyName(key, scancode);
    if (!label || !*label) return {};
    std::string name(label);
    if (name.size() == 1) name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

int as_modifiers(int glfw) {
    return (glfw & GLFW_MOD_SHIFT ? k_shift : 0) | (glfw & GLFW_MOD_CONTROL ? k_control : 0) |
           (glfw & GLFW_MOD_ALT ? k_alt : 0) | (glfw & GLFW_MOD_SUPER ? k_super : 0);
}

/// The GLFW bit of a key that is a modifier, and the key of the other hand; 0 for other keys.
struct ModifierKey {
    int bit = 0, twin = 0;
};
ModifierKey modifier_of(int key) {
    switch (key) {
    case GLFW_KEY_LEFT_SHIFT:
        return {GLFW_MOD_SHIFT, GLFW_KEY_RIGHT_SHIFT};
    case GLFW_KEY_RIGHT_SHIFT:
        return {GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT};
    case GLFW_KEY_LEFT_CONTROL:
        return {GLFW_MOD_CONTROL, GLFW_KEY_RIGHT_CONTROL};
    case GLFW_KEY_RIGHT_CONTROL:
        return {GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL};
    case GLFW_KEY_LEFT_ALT:
        return {GLFW_MOD_ALT, GLFW_KEY_RIGHT_ALT};
    case GLFW_KEY_RIGHT_ALT:
        return {GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT};
    case GLFW_KEY_LEFT_SUPER:
        return {GLFW_MOD_SUPER, GLFW_KEY_RIGHT_SUPER};
    case GLFW_KEY_RIGHT_SUPER:
        return {GLFW_MOD_SUPER, GLFW_KEY_LEFT_SUPER};
    default:
        return {};
    }
}

void on_key(GLFWwindow* handle, int key, int scancode, int action, int modifiers) {
    Window::Native& native = native_of(handle);
    native.active = true;
    if (action == GLFW_REPEAT) return; // ImGui repeats by itself
    InputEvent event;
    event.kind = InputEvent::Kind::key;
    event.code = key;
    event.down = action == GLFW_PRESS;
    if (ModifierKey modifier = modifier_of(key); modifier.bit) {
        event.kind = InputEvent::Kind::modifier;
        // What GLFW tells are the modifiers before the event on some systems, and after it on others.
        bool held = event.down || glfwGetKey(handle, modifier.twin) == GLFW_PRESS;
        modifiers = held ? modifiers | modifier.bit : modifiers & ~modifier.bit;
    }
    event.modifiers = as_modifiers(modifiers);
    std::string name = event.down ? key_name(key, scancode) : "";
    if (!name.empty()) {
        if (modifiers & GLFW_MOD_CONTROL) event.chord += "Ctrl+";
        if (modifiers & GLFW_MOD_ALT) event.chord += "Alt+";
        if (modifiers & GLFW_MOD_SHIFT) event.chord += "Shift+";
        event.chord += name;
    }
    native.input.push(std::move(event));
}

/// '?' lies elsewhere on every layout: what counts is the character.
void on_character(GLFWwindow* handle, unsigned int code) {
    Window::Native& native = native_of(handle);
    native.active = true;
    InputEvent event;
    event.kind = InputEvent::Kind::text;
    event.code = int(code);
    if (code == '?') event.chord = "?";
    native.input.push(std::move(event));
}

void push(GLFWwindow* handle, InputEvent event) {
    Window::Native& native = native_of(handle);
    native.active = true;
    native.input.push(std::move(event));
}

/// Where the pointer is now.
void push_pointer(GLFWwindow* handle) {
    double x = 0, y = 0;
    glfwGetCursorPos(handle, &x, &y);
    push(handle, {InputEvent::Kind::motion, {float(x), float(y)}, 0, false, -1, ""});
}

void on_drop(GLFWwindow* handle, int count, const char** paths) {
    Window::Native& native = native_of(handle);
    native.active = true;
    native.dropped.assign(paths, paths + count);
}

void note(GLFWwindow* handle) {
    native_of(handle).active = true;
}

/// ImGui is told of events by our queue: its backend reads pointer and buttons when a frame begins, which is too late
/// for what happened in a slow one.
void set_callbacks(GLFWwindow* handle) {
    using Kind = InputEvent::Kind;
    glfwSetKeyCallback(handle, on_key);
    glfwSetCharCallback(handle, on_character);
    glfwSetDropCallback(handle, on_drop);
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* w, int button, int action, int modifiers) {
        push(w, {Kind::button, {}, button, action == GLFW_PRESS, as_modifiers(modifiers), ""});
    });
    glfwSetScrollCallback(handle, [](GLFWwindow* w, double x, double y) {
        push(w, {Kind::wheel, {float(x), float(y)}, 0, false, -1, ""});
    });
    glfwSetCursorPosCallback(handle, [](GLFWwindow* w, double x, double y) {
        push(w, {Kind::motion, {float(x), float(y)}, 0, false, -1, ""});
    });
    glfwSetCursorEnterCallback(handle, [](GLFWwindow* w, int entered) {
        entered ? push_pointer(w) : push(w, {Kind::leave, {}, 0, false, -1, ""});
    });
    glfwSetWindowFocusCallback(handle, [](GLFWwindow* w, int focused) {
        push(w, {Kind::focus, {}, 0, focused == GLFW_TRUE, -1, ""});
    });
    glfwSetMonitorCallback(ImGui_ImplGlfw_MonitorCallback);
    glfwSetWindowRefreshCallback(handle, note);
    glfwSetWindowCloseCallback(handle, note);
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* w, int, int) { note(w); });
    glfwSetWindowContentScaleCallback(handle, [](GLFWwindow* w, float, float) {
        note(w);
        native_of(w).scale_changed = true;
    });
}

/// No larger than the screen that it opens on.
glm::ivec2 fitting(glm::ivec2 size) {
    int x = 0, y = 0, width = 0, height = 0;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    if (width > 0 && height > 0) size = glm::min(size, glm::ivec2(width, height));
    return glm::max(size, glm::ivec2(320, 240));
}

} // namespace

Window::Window(const WindowOptions& options) : native_(std::make_unique<Native>()) {
    ask_mesa_for_46();
    guard_shader_cache();
    native_->options = options;
    glfwSetErrorCallback(on_error);
    if (!glfwInit()) {
        throw Error("no window can be opened: " + last_error() +
                    "\n  without a display, pictures are made by: bounce render SHOT -o picture.png");
    }
    try {
        open(options.size, options.maximized);
    } catch (const Error&) {
        glfwTerminate();
        throw;
    }
}

Window::~Window() {
    shut();
    glfwTerminate();
}

void Window::open(glm::ivec2 size, bool maximized) {
    size = fitting(size);
    for (bool robust : {true, false}) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 6);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
        if (robust) glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
        glfwWindowHint(GLFW_MAXIMIZED, maximized ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwWindowHintString(GLFW_X11_CLASS_NAME, "bounce");
        glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "bounce");
        native_->handle = glfwCreateWindow(size.x, size.y, native_->options.title.c_str(), nullptr, nullptr);
        if (native_->handle) break;
    }
    if (!native_->handle) {
        throw Error("no window with OpenGL 4.6 can be opened: " + last_error() +
                    "\n  without one, pictures are made by: bounce render SHOT -o picture.png");
    }
    GLFWwindow* handle = native_->handle;
    glfwSetWindowUserPointer(handle, native_.get());
    glfwSetWindowSizeLimits(handle, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(handle);
    if (!gladLoadGL(glfwGetProcAddress)) {
        shut();
        throw Error("the functions of OpenGL cannot be loaded");
    }
    try {
        capabilities_ = start_context();
    } catch (const Error&) {
        shut();
        throw;
    }
    glfwSwapInterval(1);
    set_callbacks(handle);
    ImGui_ImplGlfw_InitForOpenGL(handle, false);
    ImGui_ImplOpenGL3_Init("#version 430 core");
    native_->active = true;
    native_->input.forget();
    if (glfwGetWindowAttrib(handle, GLFW_HOVERED)) push_pointer(handle);
}

void Window::shut() {
    if (!native_->handle) return;
    if (ImGui::GetCurrentContext() && ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
    if (ImGui::GetCurrentContext() && ImGui::GetIO().BackendPlatformUserData) ImGui_ImplGlfw_Shutdown();
    glfwDestroyWindow(native_->handle);
    native_->handle = nullptr;
}

void Window::make_again() {
    Native& native = *native_;
    if (native.handle) { // else it was tried before
        native.again_size = native.fullscreen ? native.windowed_size : size();
        native.again_maximized = maximized();
        native.again_fullscreen = native.fullscreen;
        shut();
    }
    native.fullscreen = false;
    open(native.again_size, native.again_maximized);
    if (native.again_fullscreen) toggle_fullscreen();
}

// --- events ----------------------------------------------------------------------------------------------------------

void Window::poll_events() {
    glfwPollEvents();
}

void Window::wait_events(double seconds) {
    glfwWaitEventsTimeout(std::max(seconds, 0.001));
}

bool Window::should_close() const {
    return glfwWindowShouldClose(native_->handle);
}

void Window::close() {
    glfwSetWindowShouldClose(native_->handle, GLFW_TRUE);
}

bool Window::take_activity() {
    return std::exchange(native_->active, false);
}

bool Window::has_input() const {
    return !native_->input.empty();
}

void Window::drop_input() {
    native_->input.forget();
}

std::vector<KeyPress> Window::take_keys() {
    return std::exchange(native_->keys, {});
}

bool Window::place_is_down(char letter) const {
    return glfwGetKey(native_->handle, GLFW_KEY_A + (letter - 'A')) == GLFW_PRESS;
}

std::vector<std::string> Window::take_dropped_files() {
    return std::exchange(native_->dropped, {});
}

bool Window::take_scale_change() {
    return std::exchange(native_->scale_changed, false);
}

// --- sizes -----------------------------------------------------------------------------------------------------------

glm::ivec2 Window::size() const {
    if (!native_->handle) return native_->again_size;
    glm::ivec2 size;
    glfwGetWindowSize(native_->handle, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::framebuffer_size() const {
    glm::ivec2 size;
    glfwGetFramebufferSize(native_->handle, &size.x, &size.y);
    return size;
}

float Window::pixel_ratio() const {
    glm::ivec2 screen = size(), pixels = framebuffer_size();
    return screen.x > 0 && pixels.x > 0 ? float(pixels.x) / float(screen.x) : 1.0f;
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(native_->handle, &x, &y);
    // Where screen coordinates are scaled already (Wayland), the ratio of pixels to them is a part of the scale.
    return std::clamp(x / pixel_ratio(), 0.5f, 4.0f);
}

bool Window::maximized() const {
    if (!native_->handle) return native_->again_maximized;
    return glfwGetWindowAttrib(native_->handle, GLFW_MAXIMIZED);
}

void Window::toggle_fullscreen() {
    Native& native = *native_;
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (native.fullscreen) {
        glfwSetWindowMonitor(native.handle, nullptr, native.windowed_position.x, native.windowed_position.y,
                             native.windowed_size.x, native.windowed_size.y, GLFW_DONT_CARE);
        native.fullscreen = false;
    } else if (monitor) {
        glfwGetWindowPos(native.handle, &native.windowed_position.x, &native.windowed_position.y);
        native.windowed_size = size();
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        glfwSetWindowMonitor(native.handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
        native.fullscreen = true;
    }
    glfwSwapInterval(1);
}

void Window::set_title(const std::string& title) {
    if (title == native_->options.title) return;
    native_->options.title = title;
    glfwSetWindowTitle(native_->handle, title.c_str());
}

void Window::capture_pointer(bool captured) {
    bool was = glfwGetInputMode(native_->handle, GLFW_CURSOR) == GLFW_CURSOR_DISABLED;
    if (was == captured) return;
    glfwSetInputMode(native_->handle, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (!captured) push_pointer(native_->handle); // it is put back to where it was hidden, without an event
}

// --- frame -----------------------------------------------------------------------------------------------------------

void Window::begin_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = std::max(io.DeltaTime, 1e-6f); // frames of input follow one another at once
    native_->input.feed(io);
    ImGui::NewFrame();
    const bool in_popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    for (std::string& chord : native_->input.take_chords())
        native_->keys.push_back({std::move(chord), io.WantTextInput, in_popup});
}

void Window::end_frame(bool shown) {
    if (!shown) return ImGui::EndFrame();
    ImGui::Render();
    glm::ivec2 pixels = framebuffer_size();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, pixels.x, pixels.y);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.08f, 0.08f, 0.08f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(native_->handle);
}

void Window::make_font_texture() {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

} // namespace bounce
