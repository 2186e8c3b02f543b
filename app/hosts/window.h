#pragma once
// The window host: an OpenGL 4.6 context on a desktop, its events, and Dear ImGui's backends. window.cpp is the only
// file that includes GLFW.

#include "gpu/capabilities.h"

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace bounce {

struct WindowOptions {
    std::string title = "Bounce";
    glm::ivec2 size{1280, 720}; ///< screen coordinates; shrunk to what the screen has
    bool maximized = false;
};

/// A key that was pressed, and what it was pressed over.
struct KeyPress {
    std::string chord;     ///< "F", "Ctrl+Shift+Z", "?", "F12", "Space"; letters as the keyboard's layout names them
    bool in_text = false;  ///< a text field had the keyboard
    bool in_popup = false; ///< a dropdown or menu was open
};

class Window {
  public:
    /// Opens a window with a robust OpenGL 4.6 core context, made current; Dear ImGui draws into it. Throws Error when
    /// there is no display, or names what the driver lacks. An ImGui context must exist, and must outlive the window.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const Capabilities& capabilities() const { return capabilities_; }

    // --- events ---
    void poll_events();
    /// Sleeps until something happens, `seconds` at most.
    void wait_events(double seconds);
    bool should_close() const;
    void close();
    /// Whether a person or the desktop did anything (input, resize, expose …) since this was last asked.
    bool take_activity();
    /// Whether there are events that no frame has been given yet: each frame takes as many as it can tell apart
    /// (input_queue.h).
    bool has_input() const;
    /// Forgets them, and what is held: nothing is drawn.
    void drop_input();
    /// Keys of the frames since last asked, in order. A press is here even when the key was released before its frame.
    std::vector<KeyPress> take_keys();
    /// Whether the key at the place of W (A, S, D, Q, E) on an English keyboard is held, whatever it is labelled.
    bool place_is_down(char letter) const;
    std::vector<std::string> take_dropped_files();
    /// The content scale changed: fonts must be made again.
    bool take_scale_change();

    // --- sizes ---
    glm::ivec2 size() const;             ///< screen coordinates, as the mouse's
    glm::ivec2 framebuffer_size() const; ///< pixels; 0 while minimized
    float pixel_ratio() const;           ///< pixels per screen coordinate
    float content_scale() const;         ///< how much larger than 96 dpi things should be, in screen coordinates
    bool maximized() const;
    void toggle_fullscreen();

    void set_title(const std::string& title);
    /// Hides the pointer and lets it move without end, for looking around.
    void capture_pointer(bool captured);

    // --- frame ---
    void begin_frame();
    /// Draws what ImGui holds and shows it; a frame that only takes input need not be `shown`.
    void end_frame(bool shown = true);
    void make_font_texture();

    // --- GPU resets ---
    /// A new window and context in the place of the lost one. Throws Error; it may then be tried again.
    void make_again();

    struct Native; ///< of window.cpp

  private:
    void open(glm::ivec2 size, bool maximized);
    void shut();

    std::unique_ptr<Native> native_;
    Capabilities capabilities_;
};

} // namespace bounce
