#include "app/ui/captures.h"

#include "app/capture.h"
#include "core/error.h"

#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

std::string capture_stem(const Session& session) {
    return session.shot().name + "_" + session.graph().model().file().name;
}

fs::path new_file(const std::string& folder, const std::string& stem, const std::string& extension) {
    fs::path base = folder.empty() ? fs::path(".") : fs::path(folder);
    std::error_code ignored;
    for (int number = 1;; ++number) {
        fs::path path = base / fmt::format("{}_{:03}{}", stem, number, extension);
        if (!fs::exists(path, ignored)) return path;
    }
}

/// Folders are made on the way: nobody should lose a picture to a missing one.
static void make_folder(const std::string& folder) {
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) throw Error("cannot create the folder '" + folder + "': " + error.message());
}

void capture_picture(PanelContext& context, const std::string& extension) {
    CaptureState& capture = context.ui.window.capture;
    make_folder(capture.folder);
    fs::path path = new_file(capture.folder, capture_stem(context.session), extension);
    write_picture(context.session, path);
    capture.last = fs::absolute(path).lexically_normal().string();
    context.ui.say("saved " + path.lexically_normal().string());
}

void start_recording(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    make_folder(capture.folder);
    // A sequence gets a number of its own, so that a second take does not overwrite the first.
    std::error_code ignored;
    std::string stem = capture_stem(context.session);
    int take = 1;
    auto pattern = [&] {
        return (fs::path(capture.folder) / fmt::format("{}_take{}_", stem, take)).lexically_normal().string();
    };
    while (fs::exists(pattern() + "0000.png", ignored))
        ++take;
    capture.pattern = pattern() + "%04d.png";
    capture.recording = true;
    capture.written = 0;
    context.ui.say("recording " + capture.pattern);
}

void stop_recording(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    capture.recording = false;
    context.ui.say(fmt::format("recorded {} frames: {}", capture.written, capture.pattern));
}

void record_frame(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    std::string start = capture.pattern.substr(0, capture.pattern.find('%'));
    fs::path path = fmt::format("{}{:04}.png", start, capture.written);
    try {
        write_picture(context.session, path);
    } catch (...) {
        capture.recording = false;
        throw;
    }
    capture.last = fs::absolute(path).lexically_normal().string();
    ++capture.written;
    if (capture.frames > 0 && capture.written >= capture.frames) stop_recording(context);
}

} // namespace bounce
