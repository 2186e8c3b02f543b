#pragma once
// What a person did, in order, and fed to Dear ImGui in steps that one frame can tell apart: the pointer, the buttons
// and the modifiers are in each frame as they were at its events, however long the frame before took.

#include <deque>
#include <glm/glm.hpp>
#include <set>
#include <string>
#include <vector>

struct ImGuiIO;

namespace bounce {

struct InputEvent {
    enum class Kind { motion, leave, button, wheel, key, modifier, text, focus };
    Kind kind = Kind::motion;
    glm::vec2 at{0}; ///< motion: the pointer, screen coordinates; wheel: notches
    int code = 0; ///< button: of the mouse; key, modifier: index of ImGuiIO::KeysDown, −1: unknown; text: character
    bool down = false;  ///< of button, key, modifier; focus: gained
    int modifiers = -1; ///< bits of InputModifier once it has happened; −1: not told
    std::string chord;  ///< key, text: as Window::take_keys() names it; empty: none
};

enum InputModifier { k_shift = 1, k_control = 2, k_alt = 4, k_super = 8 };

class InputQueue {
  public:
    void push(InputEvent event);
    bool empty() const { return events_.empty(); }
    /// Before NewFrame: as many events as one frame can tell apart, oldest first. The rest waits for the next frames:
    /// what was pressed is seen pressed, and no press is seen at a place or with modifiers that came after it.
    void feed(ImGuiIO& io);
    /// The chords of the events that were fed since this was last asked.
    std::vector<std::string> take_chords();
    /// Another window: nothing waits, nothing is held.
    void forget();

  private:
    /// What the events of this frame were.
    struct Frame {
        bool moved = false, button = false, wheeled = false, pressed = false, modifier = false, text = false,
             focus = false;
        std::set<int> keys; ///< that were pressed or released
    };
    static bool fits(const Frame& frame, const InputEvent& event);
    void apply(const InputEvent& event, Frame& frame, ImGuiIO& io);

    static constexpr int k_buttons = 5;
    std::deque<InputEvent> events_;
    std::vector<std::string> chords_;
    glm::vec2 pointer_{0};
    bool over_ = false; ///< the pointer is known
    bool buttons_[k_buttons] = {};
};

} // namespace bounce
