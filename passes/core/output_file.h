#pragma once
// Files that are written; see write_file_atomically in image.h.

#include <filesystem>

namespace bounce {

/// Throws the Error that write_file_atomically would throw for `path`, as far as it can be known before there is
/// anything to write: the folder is missing or may not be written to, the name is that of a folder or too long.
/// Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

} // namespace bounce
