#pragma once
// Every key and mouse gesture, in one table: the program acts by it, and the keys panel shows it.

#include <string>
#include <vector>

namespace bounce {

enum class KeyCommand {
    none, ///< a gesture that the viewport itself handles
    show_keys,
    palette,
    show_log,
    show_nodes,
    show_timeline,
    snapshot,
    show_left,
    show_right,
    swap_columns,
    fullscreen,
    larger_interface,
    smaller_interface,
    quit,
    undo,
    redo,
    play,
    step,
    first_frame,
    render_always,
    frame_scene,
    shot_camera,
    add_bookmark,
    bookmark, ///< 1 … 9
    open_file,
    capture_png,
    capture_exr,
    record,
    save_shot,
    reload_shot,
    lock_cursor,
    unpin,
    reset_zoom,
};

struct KeyBinding {
    const char* group;
    std::vector<std::string> chords; ///< any of these; as Window::take_keys() names them, or a gesture
    const char* what;
    KeyCommand command = KeyCommand::none;
};

const std::vector<KeyBinding>& key_bindings();
/// The command of a pressed chord; none when it has none.
KeyCommand command_of(const std::string& chord);
/// "Ctrl+S", for tooltips.
std::string chord_of(KeyCommand command);

} // namespace bounce
