#pragma once
// Pictures of the window's session as files: one, a numbered sequence, or a film.

#include "app/ui/panel_context.h"

namespace bounce {

/// Writes the present picture (".png" or ".exr") to a new name in the capture folder. Throws Error.
void capture_picture(PanelContext& context, const std::string& extension);

/// From the next frame on each one is written, and time goes on by one frame each. Throws Error when the folder cannot
/// be written, or a film is asked for and ffmpeg is not installed.
void start_recording(PanelContext& context);
/// Throws Error when a film fails.
void stop_recording(PanelContext& context);
/// Writes the frame that was just rendered; stops when enough are.
void record_frame(PanelContext& context);

/// "cornell_direct": what names of captures begin with.
std::string capture_stem(const Session& session);
/// A name that no file has yet: folder/stem_001.ext.
std::filesystem::path new_file(const std::string& folder, const std::string& stem, const std::string& extension);

} // namespace bounce
