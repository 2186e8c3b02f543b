#include "app/film.h"

#include "core/error.h"
#include "core/output_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;

namespace bounce {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_otherwise = "numbered frames (x_%04d.png) work without it";

std::string extension_of(const fs::path& path) {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string reason(int error) {
    return std::error_code(error, std::generic_category()).message();
}

bool is_installed(const char* program) {
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "/usr/bin:/bin";
    for (size_t from = 0; from <= folders.size();) {
        const size_t to = std::min(folders.find(':', from), folders.size());
        const fs::path file = fs::path(folders.substr(from, to - from)) / program;
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return true;
        from = to + 1;
    }
    return false;
}

[[noreturn]] void throw_missing() {
    throw Error(
        fmt::format("ffmpeg is not installed, and films are written by it: apt-get install ffmpeg; {}", k_otherwise));
}

/// What ffmpeg says goes there: a pipe would have to be emptied meanwhile.
int words_file() {
    std::error_code ignored;
    std::string name = (fs::temp_directory_path(ignored) / "bounce-film-XXXXXX").string();
    const int file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file >= 0) ::unlink(name.c_str());
    return file;
}

/// The same frames give the same bytes: nothing of date or version is written.
std::vector<std::string> ffmpeg_arguments(const fs::path& file, const std::string& extension, glm::ivec2 size,
                                          float fps) {
    std::vector<std::string> out = {"ffmpeg", "-hide_banner", "-nostats", "-loglevel", "error", "-y", "-f", "rawvideo",
                                    "-pixel_format", "rgb24", "-video_size", fmt::format("{}x{}", size.x, size.y),
                                    "-framerate", fmt::format("{}", fps), "-i", "pipe:0", "-an", "-vf",
                                    // Players take what says nothing of itself as BT.709 if it is large.
                                    "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,"
                                    "format=yuv420p",
                                    "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1",
                                    "-color_range", "tv", "-fflags", "+bitexact", "-flags:v", "+bitexact"};
    const std::vector<std::string> mp4 = {"-c:v",   "libx264",   "-crf",       "16", "-preset",
                                          "medium", "-movflags", "+faststart", "-f", "mp4"};
    const std::vector<std::string> webm = {"-c:v", "libvpx-vp9", "-crf", "20", "-b:v",
                                           "0",    "-row-mt",    "1",    "-f", "webm"};
    const std::vector<std::string>& encoder = extension == ".mp4" ? mp4 : webm;
    out.insert(out.end(), encoder.begin(), encoder.end());
    out.push_back("file:" + file.string());
    return out;
}

} // namespace

bool is_film(const fs::path& path) {
    const std::string extension = extension_of(path);
    return extension == ".mp4" || extension == ".webm";
}

void check_film_path(const fs::path& path) {
    std::error_code ignored;
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
        throw Error(
            fmt::format("cannot write '{}': expected a file, a film cannot go into a folder or device", path.string()));
    check_writable(path);
    if (!is_installed("ffmpeg")) throw_missing();
}

Film::Film(const fs::path& path, glm::ivec2 size, float fps) : path_(path), size_(size) {
    check_film_path(path);
    static int count = 0;
    // Beside the target, so that it can be renamed.
    const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path) : fs::absolute(path);
    path_ = target;
    aside_ = target.parent_path() / fmt::format(".bounce-film-{}-{}.tmp", ::getpid(), count++);
    try {
        start(fps);
    } catch (...) {
        end_process();
        throw;
    }
}

Film::~Film() {
    // Not finished: nobody wants what it has.
    if (process_ > 0) ::kill(process_, SIGKILL);
    end_process();
}

void Film::start(float fps) {
    words_ = words_file();
    if (words_ < 0) throw Error("cannot start ffmpeg: no temporary file: " + reason(errno));
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error("cannot start ffmpeg: " + reason(errno));
    input_ = ends[1];
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, words_, STDERR_FILENO);
    // In a process group of its own: Ctrl+C in a terminal is for this program, which then says what becomes of the
    // film. Signals mean to ffmpeg what they mean to programs.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    for (int signal : {SIGPIPE, SIGINT, SIGTERM, SIGXFSZ})
        sigaddset(&signals, signal);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    const std::vector<std::string> words = ffmpeg_arguments(aside_, extension_of(path_), size_, fps);
    std::vector<char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t process = -1;
    const int error = ::posix_spawnp(&process, "ffmpeg", &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[0]);
    if (error == ENOENT) throw_missing();
    if (error) throw Error(fmt::format("cannot start ffmpeg: {}; {}", reason(error), k_otherwise));
    process_ = process;
    ::fcntl(input_, F_SETFL, O_NONBLOCK); // one that has stopped must not stop this program
}

void Film::send(const char* bytes, size_t count) {
    constexpr int k_patience = 120'000; // milliseconds without a byte taken in
    while (count > 0) {
        const ssize_t written = ::write(input_, bytes, count);
        if (written > 0) {
            bytes += written;
            count -= size_t(written);
        } else if (written < 0 && errno == EAGAIN) {
            pollfd wait{input_, POLLOUT, 0};
            if (::poll(&wait, 1, k_patience) == 0) fail("it has taken nothing in for two minutes");
        } else if (written < 0 && errno != EINTR) {
            fail(reason(errno));
        }
    }
}

void Film::add(const Image8& frame) {
    if (frame.width != size_.x || frame.height != size_.y)
        throw Error(fmt::format("a film's frames are all of one size: this one is {}x{}, the first was {}x{}",
                                frame.width, frame.height, size_.x, size_.y));
    if (process_ < 0) throw Error("the film has ended");
    std::vector<char> rgb;
    rgb.reserve(frame.rgba.size() / 4 * 3);
    for (size_t i = 0; i + 3 < frame.rgba.size(); i += 4)
        rgb.insert(rgb.end(), &frame.rgba[i], &frame.rgba[i] + 3);
    send(rgb.data(), rgb.size());
    ++frames_;
}

void Film::finish() {
    if (process_ < 0) throw Error("the film has ended");
    ::close(std::exchange(input_, -1));
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    std::error_code error;
    if (!good) fail(WIFSIGNALED(status) ? fmt::format("it was ended by signal {}", WTERMSIG(status)) : "it gave up");
    if (fs::file_size(aside_, error) == 0 || error) fail("it wrote nothing");
    fs::rename(aside_, path_, error);
    if (error) {
        end_process();
        throw Error("cannot write '" + path_.string() + "': " + error.message());
    }
    end_process();
}

/// Closes and removes all that there is of it.
void Film::end_process() {
    if (input_ >= 0) ::close(std::exchange(input_, -1));
    int status = 0;
    while (process_ > 0 && ::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (words_ >= 0) ::close(std::exchange(words_, -1));
    if (!aside_.empty()) ::unlink(aside_.c_str());
}

/// What it said last; one line of a few.
std::string Film::last_words() const {
    std::string text(4096, '\0');
    const off_t size = ::lseek(words_, 0, SEEK_END);
    const ssize_t read = ::pread(words_, text.data(), text.size(), std::max<off_t>(0, size - off_t(text.size())));
    text.resize(size_t(std::max<ssize_t>(read, 0)));
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.pop_back();
    constexpr size_t k_shown = 400;
    if (text.size() > k_shown) text = "…" + text.substr(text.size() - k_shown);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void Film::fail(const std::string& why) {
    if (process_ > 0) {
        if (input_ >= 0) ::close(std::exchange(input_, -1));
        ::kill(process_, SIGKILL); // what closed its input has ended; what took nothing in may never do
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
    }
    const std::string words = last_words();
    const std::string name = path_.string();
    end_process();
    throw Error(fmt::format("ffmpeg did not write the film '{}' ({} frame{} given): {}; nothing was written. Is the "
                            "package ffmpeg whole? {}",
                            name, frames_, frames_ == 1 ? "" : "s", words.empty() ? why : words, k_otherwise));
}

} // namespace bounce
