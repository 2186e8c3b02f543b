#include "core/input_file.h"

#include "core/error.h"
#include "core/image.h"
#include "core/limits.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bounce {

namespace fs = std::filesystem;

static std::string error_text(int error) {
    return std::error_code(error, std::generic_category()).message();
}

static const char* kind_of(mode_t mode) {
    if (S_ISREG(mode)) return "";
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

std::string irregular_kind(const fs::path& path) {
    struct stat info;
    return ::stat(path.c_str(), &info) == 0 ? kind_of(info.st_mode) : "";
}

namespace {
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    operator int() const { return number_; }

  private:
    int number_;
};
} // namespace

std::string read_file(const fs::path& path, uint64_t max_bytes) {
    auto fail = [&path](const std::string& why) -> void { throw Error("cannot read '" + path.string() + "': " + why); };
    // Without waiting: a pipe that nobody writes to would hold the program here for ever.
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file < 0) fail(errno == ENXIO ? "it is a socket; expected a regular file" : error_text(errno));
    struct stat info;
    if (::fstat(file, &info) != 0) fail(error_text(errno));
    if (const std::string kind = kind_of(info.st_mode); !kind.empty())
        fail("it is " + kind + "; expected a regular file");
    const uint64_t size = uint64_t(info.st_size);
    if (size > max_bytes) fail(fmt::format("it has {} bytes; expected at most {}", grouped(size), grouped(max_bytes)));
    // What it grows by while it is read does not count.
    std::string bytes(size, '\0');
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(file, bytes.data() + done, std::min<size_t>(bytes.size() - done, size_t(1) << 30));
        if (count == 0) break;
        if (count > 0)
            done += size_t(count);
        else if (errno != EINTR)
            fail(error_text(errno));
    }
    bytes.resize(done);
    return bytes;
}

std::string read_file(const fs::path& path) {
    return read_file(path, k_max_exr_bytes);
}

std::string refused_path(const std::string& path) {
    if (path.empty()) return "it is empty";
    if (path.find('\0') != std::string::npos) return "it holds a NUL byte";
    return path.front() == '/' || path.front() == '\\' ? "it is an absolute path" : "";
}

std::string refused_uri(const std::string& uri) {
    if (std::string refused = refused_path(uri); !refused.empty()) return refused;
    // "http:", "file:", and "c:", a drive.
    const size_t colon = uri.find(':');
    const bool scheme = colon != std::string::npos && std::isalpha(static_cast<unsigned char>(uri[0])) &&
                        std::all_of(uri.begin(), uri.begin() + long(colon), [](unsigned char c) {
                            return std::isalnum(c) || c == '+' || c == '-' || c == '.';
                        });
    return scheme ? "it has a scheme" : "";
}

} // namespace bounce
