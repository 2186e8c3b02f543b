#include "core/memory.h"

#include "core/error.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace bounce {

namespace {

constexpr uint64_t k_unlimited = std::numeric_limits<uint64_t>::max();

/// The number of KiB behind `key` in /proc/meminfo, in bytes.
uint64_t machine_memory() {
    std::ifstream file("/proc/meminfo");
    std::string key, unit;
    for (uint64_t kib; file >> key >> kib; std::getline(file, unit))
        if (key == "MemAvailable:") return kib * 1024;
    return k_unlimited;
}

uint64_t number_in(const std::string& path) {
    std::ifstream file(path);
    uint64_t number = 0;
    return file >> number ? number : k_unlimited; // "max" is no number
}

/// Control groups, version 2: every group up to the root may have a limit.
uint64_t group_memory() {
    std::ifstream file("/proc/self/cgroup");
    uint64_t least = k_unlimited;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("0::")) continue;
        for (std::string group = line.substr(3);; group = group.substr(0, group.rfind('/'))) {
            const std::string folder = "/sys/fs/cgroup" + group;
            const uint64_t most = number_in(folder + "/memory.max"), used = number_in(folder + "/memory.current");
            if (most != k_unlimited && used != k_unlimited) least = std::min(least, most - std::min(most, used));
            if (group.find('/') == std::string::npos) break;
        }
    }
    return least;
}

uint64_t address_space_left() {
    struct rlimit limit;
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return k_unlimited;
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const uint64_t used = pages * uint64_t(::sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<uint64_t>(limit.rlim_cur, used);
}

} // namespace

uint64_t available_memory() {
    return std::min({machine_memory(), group_memory(), address_space_left()});
}

void require_memory(double bytes, const std::string& what, const std::string& remedy) {
    const uint64_t free = available_memory();
    if (bytes <= double(free)) return;
    throw Error(fmt::format("{} needs about {} of memory, but {} are free: {}", what, format_bytes(bytes),
                            format_bytes(double(free)), remedy));
}

} // namespace bounce
