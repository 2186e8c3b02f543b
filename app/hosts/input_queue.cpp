#include "app/hosts/input_queue.h"

#include <algorithm>
#include <cfloat>
#include <imgui.h>
#include <utility>

namespace bounce {

using Kind = InputEvent::Kind;

void InputQueue::push(InputEvent event) {
    // Where the pointer passed between two other events is of no interest.
    if (event.kind == Kind::motion && !events_.empty() && events_.back().kind == Kind::motion) events_.pop_back();
    events_.push_back(std::move(event));
}

bool InputQueue::fits(const Frame& frame, const InputEvent& event) {
    if (frame.focus) return false;
    bool acted = frame.button || frame.wheeled || frame.pressed || frame.text;
    switch (event.kind) {
    case Kind::motion:
    case Kind::leave:
        return !acted && !frame.modifier && frame.keys.empty();
    case Kind::button:
        // A press in a frame in which the pointer moved would drag what it lands on.
        return !acted && !frame.moved;
    case Kind::wheel:
        return !frame.button && !frame.pressed && !frame.text;
    case Kind::key:
        // Of two keys that were pressed in one frame a text field would see only one.
        return !frame.keys.contains(event.code) && !frame.button && !frame.wheeled && !frame.text &&
               (!event.down || (!frame.pressed && !frame.moved));
    case Kind::modifier:
        return !acted && !frame.moved && !frame.keys.contains(event.code);
    case Kind::text:
        return !frame.button && !frame.wheeled && !frame.moved;
    case Kind::focus:
        return !acted && !frame.moved && !frame.modifier && frame.keys.empty();
    }
    return false;
}

void InputQueue::apply(const InputEvent& event, Frame& frame, ImGuiIO& io) {
    bool held = std::any_of(std::begin(buttons_), std::end(buttons_), [](bool down) { return down; });
    switch (event.kind) {
    case Kind::motion:
        pointer_ = event.at;
        over_ = true;
        frame.moved = true;
        break;
    case Kind::leave:
        // A drag goes on outside the window.
        over_ = over_ && held;
        frame.moved = true;
        break;
    case Kind::button:
        if (event.code >= 0 && event.code < k_buttons) buttons_[event.code] = event.down;
        frame.button = true;
        break;
    case Kind::wheel:
        io.MouseWheelH += event.at.x;
        io.MouseWheel += event.at.y;
        frame.wheeled = true;
        break;
    case Kind::key:
    case Kind::modifier:
        if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[event.code] = event.down;
        frame.keys.insert(event.code);
        if (event.kind == Kind::modifier)
            frame.modifier = true;
        else if (event.down)
            frame.pressed = true;
        break;
    case Kind::text:
        io.AddInputCharacter(unsigned(event.code));
        frame.text = true;
        break;
    case Kind::focus:
        io.AddFocusEvent(event.down);
        frame.focus = true;
        break;
    }
    if (event.modifiers >= 0) {
        io.KeyShift = event.modifiers & k_shift;
        io.KeyCtrl = event.modifiers & k_control;
        io.KeyAlt = event.modifiers & k_alt;
        io.KeySuper = event.modifiers & k_super;
    }
    if (!event.chord.empty()) chords_.push_back(event.chord);
}

void InputQueue::feed(ImGuiIO& io) {
    Frame frame;
    while (!events_.empty() && fits(frame, events_.front())) {
        apply(events_.front(), frame, io);
        events_.pop_front();
    }
    io.MousePos = over_ ? ImVec2(pointer_.x, pointer_.y) : ImVec2(-FLT_MAX, -FLT_MAX);
    for (int i = 0; i < k_buttons; ++i)
        io.MouseDown[i] = buttons_[i];
}

std::vector<std::string> InputQueue::take_chords() {
    return std::exchange(chords_, {});
}

void InputQueue::forget() {
    *this = {};
}

} // namespace bounce
