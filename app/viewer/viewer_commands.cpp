// What keys do.
#include "app/ui/camera_path.h"
#include "app/ui/captures.h"
#include "app/ui/open.h"
#include "app/ui/open_dialog.h"
#include "app/ui/shot_writer.h"
#include "app/ui/snapshots.h"
#include "app/viewer/viewer_app.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

/// What changes neither the session nor what is on the GPU, and so can be done while a frame is rendered.
static bool is_of_the_window(KeyCommand command) {
    switch (command) {
    case KeyCommand::show_keys:
    case KeyCommand::palette:
    case KeyCommand::show_log:
    case KeyCommand::show_timeline:
    case KeyCommand::show_nodes:
    case KeyCommand::show_left:
    case KeyCommand::show_right:
    case KeyCommand::swap_columns:
    case KeyCommand::open_file:
    case KeyCommand::quit:
    case KeyCommand::play:
    case KeyCommand::render_always:
    case KeyCommand::add_bookmark:
    case KeyCommand::reset_zoom:
    case KeyCommand::lock_cursor:
    case KeyCommand::unpin:
        return true;
    default:
        return false;
    }
}

void ViewerApp::run_command(const KeyPress& key) {
    const std::string& chord = key.chord;
    // While text is typed, keys are letters; but a function key is never part of a text.
    bool function_key = chord.find('F') != std::string::npos && std::isdigit(static_cast<unsigned char>(chord.back()));
    if (key.in_text && !function_key) return;
    if (key.in_popup && chord == "Escape") return; // it closed the dropdown
    KeyCommand command = command_of(chord);
    if (command == KeyCommand::none) return;
    gui_frames_ = 4;
    if (ui_.mid_frame && !is_of_the_window(command)) return waiting_keys_.push_back(key);
    attempt([&] {
        handle_time(command);
        handle_camera(command, chord);
        handle_files(command);
        handle_window(command);
    });
}

void ViewerApp::handle_time(KeyCommand command) {
    switch (command) {
    case KeyCommand::play:
        ui_.paused = !ui_.paused;
        break;
    case KeyCommand::step:
        ui_.single_step = true;
        break;
    case KeyCommand::first_frame:
        session_->set_frame(0);
        ui_.redraw();
        break;
    case KeyCommand::render_always:
        ui_.render_always = !ui_.render_always;
        break;
    default:
        break;
    }
}

/// The camera of the nth bookmark of this shot.
static const Bookmark* bookmark_of(const WindowState& state, const std::string& shot, int number) {
    for (const Bookmark& mark : state.bookmarks) {
        if (mark.shot == shot && --number == 0) return &mark;
    }
    return nullptr;
}

void ViewerApp::handle_camera(KeyCommand command, const std::string& chord) {
    switch (command) {
    case KeyCommand::frame_scene:
        session_->set_camera(camera_of_whole_scene(*session_), true);
        break;
    case KeyCommand::shot_camera: {
        PanelContext panels = context();
        go_to_shot_camera(panels);
        break;
    }
    case KeyCommand::add_bookmark: {
        const std::string& shot = session_->options().shot;
        auto here = [&](const Bookmark& mark) { return mark.shot == shot; };
        long count = std::count_if(ui_.window.bookmarks.begin(), ui_.window.bookmarks.end(), here);
        ui_.window.bookmarks.push_back({shot, fmt::format("view {}", count + 1), session_->camera()});
        ui_.say(fmt::format("bookmark {} added", count + 1));
        return;
    }
    case KeyCommand::bookmark: {
        const Bookmark* mark = bookmark_of(ui_.window, session_->options().shot, chord.back() - '0');
        if (!mark) return ui_.say("there is no bookmark " + chord + " for this shot; B makes one");
        session_->set_camera(mark->camera, true);
        ui_.say(mark->name);
        break;
    }
    case KeyCommand::reset_zoom:
        ui_.window.image_zoom = 1;
        return;
    case KeyCommand::lock_cursor:
        ui_.cursor_locked = !ui_.cursor_locked && ui_.cursor_pixel.x >= 0;
        return;
    case KeyCommand::unpin:
        if (ui_.show_keys)
            ui_.show_keys = false;
        else {
            ui_.pinned.clear();
            ui_.viewer = {};
        }
        return;
    default:
        return;
    }
    ui_.redraw();
}

void ViewerApp::handle_files(KeyCommand command) {
    PanelContext panels = context();
    const bool of_the_picture = command == KeyCommand::capture_png || command == KeyCommand::capture_exr ||
                                command == KeyCommand::save_shot || command == KeyCommand::snapshot;
    if (of_the_picture && motion_share_ < 1) {
        moved_at_ = -1e9; // it rests: what is kept has all pixels
        fit_picture();
        render();
    }
    if (of_the_picture && session_->measure_moved_needs()) render();
    switch (command) {
    case KeyCommand::capture_png:
        capture_picture(panels, ".png");
        break;
    case KeyCommand::capture_exr:
        capture_picture(panels, ".exr");
        break;
    case KeyCommand::record:
        ui_.window.capture.recording ? stop_recording(panels) : start_recording(panels);
        break;
    case KeyCommand::snapshot:
        take_snapshot(panels);
        break;
    case KeyCommand::save_shot:
        save_shot(panels);
        break;
    case KeyCommand::open_file:
        ask_for_open_dialog(panels);
        break;
    case KeyCommand::reload_shot:
        ask_for_shot_again(panels);
        break;
    default:
        break;
    }
}

void ViewerApp::handle_window(KeyCommand command) {
    auto scale = [&](float factor) {
        ui_.window.interface_scale = std::clamp(ui_.window.interface_scale * factor, 0.5f, 3.0f);
        make_interface();
    };
    switch (command) {
    case KeyCommand::show_keys:
        ui_.show_keys = !ui_.show_keys;
        break;
    case KeyCommand::palette:
        palette_.open(palette_entries(context(), [this](const std::string& chord) { run_command({chord}); }));
        break;
    case KeyCommand::show_log:
        toggle_bottom(ui_.window, "Log");
        break;
    case KeyCommand::show_timeline:
        toggle_bottom(ui_.window, "Over time");
        break;
    case KeyCommand::show_nodes:
        toggle_bottom(ui_.window, "Nodes");
        break;
    case KeyCommand::show_left:
        ui_.window.layout.show_left = !ui_.window.layout.show_left;
        break;
    case KeyCommand::show_right:
        ui_.window.layout.show_right = !ui_.window.layout.show_right;
        break;
    case KeyCommand::swap_columns:
        ui_.window.layout.swapped = !ui_.window.layout.swapped;
        break;
    case KeyCommand::fullscreen:
        window_->toggle_fullscreen();
        break;
    case KeyCommand::larger_interface:
        scale(1.1f);
        break;
    case KeyCommand::smaller_interface:
        scale(1 / 1.1f);
        break;
    case KeyCommand::quit:
        window_->close();
        break;
    case KeyCommand::undo:
        note_camera(); // also one that has not come to rest
        ui_.say(undo_.next_undo().empty() ? "nothing to undo" : "undone: " + undo_.next_undo());
        undo_.undo();
        ui_.redraw();
        break;
    case KeyCommand::redo:
        ui_.say(undo_.next_redo().empty() ? "nothing to redo" : "redone: " + undo_.next_redo());
        undo_.redo();
        ui_.redraw();
        break;
    default:
        break;
    }
}

} // namespace bounce
