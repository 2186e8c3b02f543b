#include "app/ui/captures.h"

#include "app/capture.h"
#include "app/film.h"
#include "core/error.h"

#include <fmt/format.h>
#include <utility>

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
    context.session.finish_frame();
    fs::path path = new_file(capture.folder, capture_stem(context.session), extension);
    write_picture(context.session, path);
    capture.last = fs::absolute(path).lexically_normal().string();
    context.ui.say("saved " + path.lexically_normal().string());
}

/// A recording gets a name of its own, so that a second take does not overwrite the first.
static std::string new_sequence(const CaptureState& capture, const std::string& stem) {
    std::error_code ignored;
    for (int take = 1;; ++take) {
        const std::string start =
            (fs::path(capture.folder) / fmt::format("{}_take{}_", stem, take)).lexically_normal().string();
        if (!fs::exists(start + "0000.png", ignored)) return start + "%04d.png";
    }
}

void start_recording(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    make_folder(capture.folder);
    const std::string stem = capture_stem(context.session);
    capture.film.reset();
    if (capture.kind == RecordingKind::numbered_png) {
        capture.pattern = new_sequence(capture, stem);
    } else {
        const fs::path file = new_file(capture.folder, stem, capture.kind == RecordingKind::mp4 ? ".mp4" : ".webm");
        check_film_path(file);
        capture.pattern = file.lexically_normal().string();
    }
    capture.recording = true;
    capture.written = 0;
    context.ui.say("recording " + capture.pattern);
}

void stop_recording(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    capture.recording = false;
    if (const std::shared_ptr<Film> film = std::exchange(capture.film, nullptr)) {
        film->finish();
        capture.last = fs::absolute(capture.pattern).lexically_normal().string();
    }
    context.ui.say(fmt::format("recorded {} frames: {}", capture.written, capture.pattern));
}

/// Its size is that of its first frame.
static void record_film_frame(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    const glm::ivec2 size = context.session.size();
    if (!capture.film) capture.film = std::make_shared<Film>(capture.pattern, size, context.session.shot().fps);
    if (capture.film->size() == size) {
        capture.film->add(display_picture(context.session));
        ++capture.written;
        return;
    }
    stop_recording(context);
    context.ui.say(fmt::format("the picture's size changed, and so the film ended after {} frames: {}", capture.written,
                               capture.pattern));
}

void record_frame(PanelContext& context) {
    CaptureState& capture = context.ui.window.capture;
    try {
        if (is_film(capture.pattern)) {
            record_film_frame(context);
        } else {
            const std::string start = capture.pattern.substr(0, capture.pattern.find('%'));
            const fs::path path = fmt::format("{}{:04}.png", start, capture.written);
            write_picture(context.session, path);
            capture.last = fs::absolute(path).lexically_normal().string();
            ++capture.written;
        }
    } catch (...) {
        capture.recording = false;
        capture.film.reset();
        throw;
    }
    if (capture.recording && capture.frames > 0 && capture.written >= capture.frames) stop_recording(context);
}

} // namespace bounce
