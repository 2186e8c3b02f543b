// Whole files: read at once, written aside and renamed.

#include "core/error.h"
#include "core/image.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

void write_file_atomically(const fs::path& path, const std::string& bytes) {
    auto fail = [&path](int error) -> void { throw Error("cannot write '" + path.string() + "': " + reason(error)); };
    std::error_code ignored;
    if (path.filename().empty()) throw Error("cannot write '" + path.string() + "': a file name is needed");
    fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    if (fs::is_directory(target, ignored)) throw Error("cannot write '" + path.string() + "': it is a folder");

    // A device or pipe cannot be replaced by a file: write into it.
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
        int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) fail(errno);
        if (int error = write_and_close(descriptor, bytes, false)) fail(error);
        return;
    }

    fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) {
        throw Error("cannot write '" + path.string() + "': there is no folder '" + folder.string() + "'");
    }
    static std::atomic<unsigned> counter{0};
    fs::path temporary = folder / (".bounce-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
    int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(errno);
    struct stat old;
    if (::stat(target.c_str(), &old) == 0) (void)!::fchmod(descriptor, old.st_mode & 07777);
    int error = write_and_close(descriptor, bytes, true);
    if (!error && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error) {
        ::unlink(temporary.c_str());
        fail(error);
    }
}

std::string read_file(const fs::path& path) {
    auto fail = [&path](int error) -> void { throw Error("cannot read '" + path.string() + "': " + reason(error)); };
    int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(errno);
    struct stat info;
    std::string bytes;
    if (::fstat(descriptor, &info) == 0 && info.st_size > 0) bytes.reserve(size_t(info.st_size));
    char buffer[1 << 16];
    while (true) {
        ssize_t count = ::read(descriptor, buffer, sizeof(buffer));
        if (count == 0) break;
        if (count > 0) {
            bytes.append(buffer, size_t(count));
        } else if (errno != EINTR) {
            int error = errno;
            ::close(descriptor);
            fail(error);
        }
    }
    ::close(descriptor);
    return bytes;
}

} // namespace bounce
