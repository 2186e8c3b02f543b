#include "app/ui/keys.h"

#include <algorithm>

namespace bounce {

const std::vector<KeyBinding>& key_bindings() {
    using enum KeyCommand;
    static const std::vector<KeyBinding> table = {
        {"Camera", {"Right mouse"}, "look around; with W A S D fly, with E and Q rise and sink"},
        {"Camera", {"Right mouse + Shift"}, "fly four times as fast"},
        {"Camera", {"Right mouse + wheel"}, "fly faster or slower from now on"},
        {"Camera", {"Left mouse"}, "turn about the surface under the pointer"},
        {"Camera", {"Middle mouse"}, "move sideways with the surface under the pointer"},
        {"Camera", {"Wheel"}, "move toward the surface under the pointer, or away"},
        {"Camera", {"F"}, "see the whole scene", frame_scene},
        {"Camera", {"Home"}, "back to the shot's camera; a path from bookmarks is dropped", shot_camera},
        {"Camera", {"B"}, "bookmark this camera", add_bookmark},
        {"Camera", {"1", "2", "3", "4", "5", "6", "7", "8", "9"}, "go to a bookmark", bookmark},
        {"Picture", {"Ctrl + wheel"}, "magnify the picture"},
        {"Picture", {"Ctrl+0"}, "the picture in its own size", reset_zoom},
        {"Picture", {"I"}, "hold the pixel inspector where it is, or let it follow", lock_cursor},
        {"Picture", {"Escape"}, "show the final picture again (unpin)", unpin},
        {"Time", {"Space"}, "play or pause", play},
        {"Time", {".", "Right"}, "one frame on", step},
        {"Time", {"0"}, "back to the first frame", first_frame},
        {"Time", {"C"}, "render continuously, also when nothing changes", render_always},
        {"Files", {"Ctrl+O"}, "open a file of a folder, or one that was opened last", open_file},
        {"Files", {"Ctrl+S", "Ctrl+E"}, "save what is seen as a shot", save_shot},
        {"Files", {"F12"}, "save the picture as PNG", capture_png},
        {"Files", {"Shift+F12"}, "save its linear parts as EXR", capture_exr},
        {"Files", {"P"}, "take a snapshot of the picture, its settings and figures", snapshot},
        {"Files", {"Ctrl+R"}, "record numbered frames or a film, or stop", record},
        {"Files", {"F5"}, "read the shot again from its file, without your edits", reload_shot},
        {"Files", {"Drop a file"}, "open a .gltf, a .glb, a shot, a graph, or a .hdr as the sky"},
        {"Window", {"Ctrl+P"}, "find an action, shot, graph, parameter or view by its name", palette},
        {"Window", {"Ctrl+Z"}, "undo", undo},
        {"Window", {"Ctrl+Shift+Z", "Ctrl+Y"}, "redo", redo},
        {"Window", {"?", "F1"}, "show or hide these keys", show_keys},
        {"Window", {"L"}, "show or hide the log", show_log},
        {"Window", {"N"}, "show or hide the graph as boxes and wires", show_nodes},
        {"Window", {"T"}, "show or hide the plots over time", show_timeline},
        {"Window", {"Tab"}, "hide or show the right column", show_right},
        {"Window", {"Shift+Tab"}, "hide or show the left column", show_left},
        {"Window", {"F4"}, "swap the columns (a tab's menu moves the tab)", swap_columns},
        {"Window", {"F11"}, "whole screen", fullscreen},
        {"Window", {"Ctrl++", "Ctrl+=", "Ctrl+Shift+="}, "larger text", larger_interface},
        {"Window", {"Ctrl+-"}, "smaller text", smaller_interface},
        {"Window", {"Ctrl+Q"}, "quit", quit},
    };
    return table;
}

KeyCommand command_of(const std::string& chord) {
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.command == KeyCommand::none) continue;
        if (std::find(binding.chords.begin(), binding.chords.end(), chord) != binding.chords.end())
            return binding.command;
    }
    return KeyCommand::none;
}

std::string chord_of(KeyCommand command) {
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.command == command) return binding.chords.front();
    }
    return {};
}

} // namespace bounce
