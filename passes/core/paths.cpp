#include "core/paths.h"

#include "core/error.h"

#include <cstdlib>
#include <string>

namespace bounce {

namespace fs = std::filesystem;

static bool is_root(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_directory(folder / "glsl", ignored) && fs::is_directory(folder / "assets", ignored);
}

fs::path root_folder() {
    if (const char* set = std::getenv("BOUNCE_ROOT")) {
        if (is_root(set)) return set;
        throw Error(std::string("BOUNCE_ROOT is '") + set + "', but there is no glsl/ and assets/ in it");
    }
    std::error_code ignored;
    fs::path executable = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const fs::path& candidate :
         {executable, executable / ".." / "share" / "bounce", fs::path(BOUNCE_SOURCE_DIR)}) {
        if (is_root(candidate)) return fs::weakly_canonical(candidate);
    }
    throw Error("no glsl/ and assets/ found beside '" + executable.string() +
                "' nor in '" BOUNCE_SOURCE_DIR "'; set BOUNCE_ROOT to the folder that holds them");
}

static fs::path user_folder(const char* variable, const char* below_home) {
    const char* set = std::getenv(variable);
    const char* home = std::getenv("HOME");
    fs::path folder = set && *set ? fs::path(set) / "bounce" : fs::path(home ? home : "/tmp") / below_home / "bounce";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error("cannot create the folder '" + folder.string() + "': " + error.message());
    return folder;
}

fs::path cache_folder() {
    return user_folder("XDG_CACHE_HOME", ".cache");
}

fs::path state_folder() {
    return user_folder("XDG_STATE_HOME", ".local/state");
}

} // namespace bounce
