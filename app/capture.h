#pragma once
// Pictures of a session as files, with what made them.

#include "app/session.h"
#include "core/image.h"

#include <filesystem>
#include <string>

namespace bounce {

/// JSON: shot, graph, every parameter that is not at its default, camera, frame, size, renderer, commit.
std::string picture_metadata(const Session& session, const std::string& resource);

/// One 2D layer of a texture as floats, the first three channels times `scale` (Session::value_scale).
Image read_layer(const GpuTexture& texture, int mip = 0, int layer = 0, float scale = 1);

/// Every out.* part of the present picture but the display: three channels each, one for occlusion.
LayeredImage read_parts(const Session& session);

/// out.display, or the resource clamped to [0,1] and sRGB-encoded unless it is 8-bit already. Throws Error.
Image8 display_picture(const Session& session, const std::string& resource = "");

/// Writes the session's present picture. `.exr`: every out.* part as a named layer, out.radiance also as the plain one
/// that other programs show (or the one resource, plain; each layer or slice of an array as "name.0", …, the first also
/// plain); `.png`: display_picture(). Throws Error (unknown resource with the nearest, unwritable path, other
/// extension).
void write_picture(const Session& session, const std::filesystem::path& path, const std::string& resource = "");

/// Bytes that write_picture takes of main memory, about: what is read back, and the encoded file. Wants a planned
/// graph.
double picture_bytes(const Session& session, const std::filesystem::path& path, const std::string& resource = "");

/// Refuses an output path that cannot work before anything is computed: its extension, its name and its folder.
void check_output_path(const std::filesystem::path& path);

/// The same for any file that is to be written.
void check_output_file(const std::filesystem::path& path);

/// The commit that the program was built from.
const char* program_commit();

} // namespace bounce
