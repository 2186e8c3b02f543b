#pragma once
// A folder of the process's own for files that nobody keeps.

#include <filesystem>

namespace bounce {

/// Made at once, in the system's folder for temporary files; removed with all that is in it at the end. Throws Error
/// when it cannot be made.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace bounce
