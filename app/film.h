#pragma once
// Films by the program ffmpeg, where it is installed: frames go as raw RGB to its standard input.

#include "core/image.h"

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace bounce {

/// Whether a file of that name is a film: .mp4 (H.264) or .webm (VP9), in any case.
bool is_film(const std::filesystem::path& path);

/// Throws Error, which names the package, where ffmpeg is not on PATH; also for a name that cannot be written.
void check_film_path(const std::filesystem::path& path);

/// A film that is being written. The file comes into being when it is finished: what is written aside until then is
/// removed otherwise.
class Film {
  public:
    /// `size` of every frame, pixels; odd ones are padded to even ones by a black row or column. Throws as
    /// check_film_path.
    Film(const std::filesystem::path& path, glm::ivec2 size, float fps);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Waits until ffmpeg has taken it in. Throws Error (another size; ffmpeg's own words when it ended).
    void add(const Image8& frame);
    /// Waits until the film is written. Throws Error.
    void finish();

    glm::ivec2 size() const { return size_; }

  private:
    void start(float fps);
    void send(const char* bytes, size_t count);
    void end_process();
    [[noreturn]] void fail(const std::string& why);
    std::string last_words() const;

    std::filesystem::path path_, aside_;
    glm::ivec2 size_;
    int process_ = -1, input_ = -1, words_ = -1; ///< its id; descriptors of its standard input and error
    int frames_ = 0;
};

} // namespace bounce
