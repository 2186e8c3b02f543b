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
    // A relative path would mean another folder in each place that the program is started from.
    auto absolute = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value == '/' ? fs::path(value) : fs::path();
    };
    fs::path folder = absolute(variable);
    if (folder.empty()) {
        folder = absolute("HOME");
        // Not /tmp: what others can write there cannot be relied on.
        if (folder.empty())
            throw Error(std::string("neither ") + variable +
                        " nor HOME is set: expected the absolute path of a folder "
                        "of one's own in one of them");
        folder /= below_home;
    }
    folder /= "bounce";
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
