#include "core/file_watch.h"

#include <sys/stat.h>

namespace bounce {

FileWatch::Stamp FileWatch::stamp_of(const std::filesystem::path& file) {
    struct stat info;
    if (::stat(file.c_str(), &info) != 0) return {};
    return {(long long)info.st_ino, (long long)info.st_size, (long long)info.st_mtim.tv_sec,
            (long long)info.st_mtim.tv_nsec};
}

void FileWatch::watch(const std::vector<std::filesystem::path>& files) {
    std::map<std::filesystem::path, Stamp> next;
    for (const auto& file : files) {
        auto known = files_.find(file);
        next[file] = known != files_.end() ? known->second : stamp_of(file);
    }
    files_ = std::move(next);
}

std::vector<std::filesystem::path> FileWatch::poll() {
    std::vector<std::filesystem::path> changed;
    for (auto& [file, stamp] : files_) {
        Stamp now = stamp_of(file);
        if (now == stamp) continue;
        stamp = now;
        changed.push_back(file);
    }
    return changed;
}

} // namespace bounce
