#pragma once
// Files that are read. Only regular files are: a pipe would wait for ever, and a device such as /dev/zero never ends.

#include <cstdint>
#include <filesystem>
#include <string>

namespace bounce {

/// The whole file, as long as it is when it is opened. Throws Error when it cannot be read, is a folder, pipe, socket
/// or device, or has more than `max_bytes` bytes.
std::string read_file(const std::filesystem::path& path, uint64_t max_bytes);

/// "a folder", "a pipe", … for messages; "" for a regular file or none at all.
std::string irregular_kind(const std::filesystem::path& path);

/// Why `path`, which a file names (a glTF file, a shot, an include), may not be read from there; "" when it may: it is
/// relative (perhaps with ..), and holds no NUL byte.
std::string refused_path(const std::string& path);
/// The same for a URI, which must not have a scheme (file:, http:) either.
std::string refused_uri(const std::string& uri);

} // namespace bounce
