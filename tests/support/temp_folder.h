#pragma once
// A folder of a test's own, and a copy of the program's root in one, whose shaders and graphs may be edited.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>

namespace bounce {

class TempFolder {
  public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "bounce_test_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// Writes in place. Every write gets a new time stamp, however coarse the file system's clock is.
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        static int edits = 0;
        std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() +
                                                   std::chrono::milliseconds(++edits));
    }
    /// As editors save: a new file beside it, renamed over it.
    void save_by_rename(const std::string& name, const std::string& text) const {
        write(name + ".new", text);
        std::filesystem::rename(path_ / (name + ".new"), path_ / name);
    }
    void remove(const std::string& name) const { std::filesystem::remove(path_ / name); }
    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
        return text.str();
    }
    /// Replaces one occurrence of `from`, which must be there.
    void edit(const std::string& name, const std::string& from, const std::string& to) const {
        std::string text = read(name);
        size_t at = text.find(from);
        if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in " + name);
        write(name, text.replace(at, from.size(), to));
    }

  private:
    std::filesystem::path path_;
};

/// Sets an environment variable and puts it back.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const std::string& value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old, had_ = true;
        ::setenv(name, value.c_str(), 1);
    }
    ~ScopedVariable() {
        if (had_)
            ::setenv(name_, old_.c_str(), 1);
        else
            ::unsetenv(name_);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

  private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

/// The real root: $BOUNCE_ROOT as the tests are given it, else the source tree.
inline std::filesystem::path real_root() {
    static const std::filesystem::path root = [] {
        const char* set = std::getenv("BOUNCE_ROOT");
        return set ? std::filesystem::path(set) : std::filesystem::path(BOUNCE_TESTS_DIR).parent_path();
    }();
    return root;
}

/// A root of its own, with copies of the shaders and graphs; scenes and shots are the real ones. While it lives,
/// BOUNCE_ROOT points to it.
class TempRoot : public TempFolder {
  public:
    /// `empty`: no shaders and graphs but those that the test writes.
    explicit TempRoot(bool empty = false) : root_("BOUNCE_ROOT", keep_real_root(path()).string()) {
        namespace fs = std::filesystem;
        fs::create_directories(path() / "glsl");
        fs::create_directories(path() / "assets" / "graphs");
        fs::create_directory_symlink(real_root() / "assets" / "scenes", path() / "assets" / "scenes");
        fs::create_directory_symlink(real_root() / "assets" / "shots", path() / "assets" / "shots");
        if (empty) return;
        auto options = fs::copy_options::recursive | fs::copy_options::overwrite_existing;
        fs::copy(real_root() / "glsl", path() / "glsl", options);
        fs::copy(real_root() / "assets" / "graphs", path() / "assets" / "graphs", options);
    }

  private:
    static const std::filesystem::path& keep_real_root(const std::filesystem::path& own) {
        real_root(); // before the variable changes
        return own;
    }
    ScopedVariable root_;
};

} // namespace bounce
