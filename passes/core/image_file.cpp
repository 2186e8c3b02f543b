// Whole files, written aside and renamed.

#include "core/error.h"
#include "core/image.h"
#include "core/output_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace bounce {

namespace fs = std::filesystem;

static std::string reason(int error) {
    return std::error_code(error, std::generic_category()).message();
}

/// Writes everything to the open descriptor and closes it. Returns 0 or the errno of what failed: a full disk shows
/// itself in write, in fsync or (on network folders) only in close.
static int write_and_close(int descriptor, const std::string& bytes, bool sync) {
    int error = 0;
    for (size_t done = 0; done < bytes.size() && !error;) {
        ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
        if (count > 0)
            done += size_t(count);
        else if (count == 0)
            error = ENOSPC;
        else if (errno != EINTR)
            error = errno;
    }
    if (!error && sync && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && !error) error = errno;
    return error;
}

[[noreturn]] static void fail(const fs::path& path, const std::string& why) {
    throw Error("cannot write '" + path.string() + "': " + why);
}

/// The file that a name stands for: links are followed. Throws for what cannot be a file.
static fs::path target_of(const fs::path& path) {
    std::error_code ignored;
    if (path.filename().empty()) fail(path, "a file name is needed");
    fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    if (fs::is_directory(target, ignored)) fail(path, "it is a folder");
    return target;
}

/// A device or pipe cannot be replaced by a file: it is written into.
static bool is_device(const fs::path& target) {
    std::error_code ignored;
    return fs::exists(target, ignored) && !fs::is_regular_file(target, ignored);
}

/// Opened without waiting: a pipe that nobody reads would hold the program here for ever.
static int open_device(const fs::path& path, const fs::path& target) {
    int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) fail(path, errno == ENXIO ? "nobody reads from it" : reason(errno));
    ::fcntl(descriptor, F_SETFL, 0); // writing may wait
    return descriptor;
}

namespace {
/// A new file beside the target; removed again unless it was renamed.
class Aside {
  public:
    Aside(const fs::path& path, const fs::path& target) {
        static std::atomic<unsigned> counter{0};
        fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
        std::error_code ignored;
        if (!fs::is_directory(folder, ignored)) fail(path, "there is no folder '" + folder.string() + "'");
        // A name that is too long shows itself here already.
        struct stat old;
        if (::stat(target.c_str(), &old) == 0)
            mode_ = old.st_mode & 07777;
        else if (errno != ENOENT)
            fail(path, reason(errno));
        path_ = folder / (".bounce-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0) fail(path, reason(errno));
        if (mode_) (void)!::fchmod(descriptor_, *mode_);
    }
    ~Aside() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

    /// Returns 0 or an errno.
    int write(const std::string& bytes) { return write_and_close(std::exchange(descriptor_, -1), bytes, true); }
    int rename_to(const fs::path& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
        path_.clear();
        return 0;
    }

  private:
    fs::path path_;
    int descriptor_ = -1;
    std::optional<mode_t> mode_;
};
} // namespace

void check_writable(const fs::path& path) {
    const fs::path target = target_of(path);
    if (is_device(target)) {
        // A pipe may get its reader later.
        if (::access(target.c_str(), W_OK) != 0) fail(path, reason(errno));
        return;
    }
    Aside aside(path, target);
}

void write_file_atomically(const fs::path& path, const std::string& bytes) {
    const fs::path target = target_of(path);
    if (is_device(target)) {
        if (int error = write_and_close(open_device(path, target), bytes, false)) fail(path, reason(error));
        return;
    }
    Aside aside(path, target);
    int error = aside.write(bytes);
    if (!error) error = aside.rename_to(target);
    if (error) fail(path, reason(error));
}

} // namespace bounce
