#include "gpu/shader_cache.h"

#include "core/log.h"
#include "core/text.h"

#include <cstdlib>
#include <fcntl.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bounce {

namespace fs = std::filesystem;

static bool is_set(const char* name) {
    const char* text = std::getenv(name);
    if (!text) return false;
    for (const char* yes : {"1", "true", "t", "yes", "y"})
        if (strcasecmp(text, yes) == 0) return true;
    return false;
}

fs::path shader_cache_folder() {
    if (is_set("MESA_SHADER_CACHE_DISABLE") || is_set("MESA_GLSL_CACHE_DISABLE")) return {};
    const auto below = [](const char* variable, const char* folder) {
        const char* text = std::getenv(variable);
        return text && *text ? fs::path(text) / folder : fs::path();
    };
    for (const char* variable : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"})
        if (fs::path folder = below(variable, "mesa_shader_cache"); !folder.empty()) return folder;
    return below("HOME", ".cache/mesa_shader_cache");
}

bool guard_shader_cache() {
    const fs::path folder = shader_cache_folder();
    if (folder.empty()) return false;
    std::error_code problem;
    fs::path there = fs::absolute(folder, problem);
    while (!fs::exists(there, problem) && there.has_relative_path())
        there = there.parent_path();
    const fs::space_info space = fs::space(there, problem);
    if (problem || space.available >= k_least_cache_space) return true;
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    spdlog::warn("Mesa's shader cache is off: '{}' has {} free, and it needs {}; shaders are compiled at each start",
                 there.string(), format_bytes(double(space.available)), format_bytes(double(k_least_cache_space)));
    return false;
}

void settle_shader_cache() {
    const fs::path folder = shader_cache_folder();
    if (folder.empty()) return;
    const int file = ::open((folder / "index").c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) return; // another driver's, or a later Mesa, which has none
    struct stat status {};
    constexpr off_t k_most = off_t(16) << 20; // of what is no index of Mesa's
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0 && status.st_size <= k_most &&
        status.st_blocks * 512 < status.st_size)
        (void)::fallocate(file, 0, 0, status.st_size); // what is there stays; not where the file system cannot
    ::close(file);
}

} // namespace bounce
