#include "gpu/shader_paths.h"

#include "core/error.h"

#include <algorithm>

namespace bounce {

namespace fs = std::filesystem;

static bool is_below(const fs::path& file, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Without the empty last part of "glsl/".
static fs::path plain(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

void check_shader_path(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    const bool named_below = is_below(plain(file), plain(folder));
    const bool lies_below = !error && (is_below(real, fs::weakly_canonical(folder, error)) ||
                                       is_below(real, fs::weakly_canonical(folder / "user", error)));
    if (!named_below || !lies_below)
        throw Error("invalid shader file '" + file.string() + "': expected one below '" + folder.string() + "'");
}

} // namespace bounce
