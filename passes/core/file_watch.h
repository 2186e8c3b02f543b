#pragma once
// Notices that files changed. Polls path, inode, size and time stamp, so it sees edits in place, saves by rename,
// files that appear and files that vanish alike.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace bounce {

class FileWatch {
  public:
    /// Watches exactly these files from now on (files that do not exist yet are watched for their appearance).
    /// Files already watched keep their known stamp, so no change between two calls is lost.
    void watch(const std::vector<std::filesystem::path>& files);
    /// The files that changed since the last poll.
    std::vector<std::filesystem::path> poll();

  private:
    struct Stamp {
        long long inode = -1, size = -1, seconds = 0, nanoseconds = 0;
        bool operator==(const Stamp&) const = default;
    };
    static Stamp stamp_of(const std::filesystem::path& file);
    std::map<std::filesystem::path, Stamp> files_;
};

} // namespace bounce
