#include "app/origin.h"

#include "app/capture.h"

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <glad/gl.h>
#include <thread>

namespace bounce {

static std::string gl_text(GLenum name) {
    const GLubyte* text = glad_glGetString ? glGetString(name) : nullptr;
    return text ? reinterpret_cast<const char*>(text) : "";
}

static std::string machine() {
    std::string processor = "unknown processor", line;
    std::ifstream file("/proc/cpuinfo");
    while (std::getline(file, line)) {
        if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
            processor = line.substr(line.find(": ") + 2);
            break;
        }
    }
    return fmt::format("{} × {}", std::thread::hardware_concurrency(), processor);
}

static std::string date() {
    const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t now = fixed && *fixed ? std::time_t(std::atoll(fixed)) : std::time(nullptr);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

Origin origin_here() {
    return {program_commit(), machine(), gl_text(GL_RENDERER), gl_text(GL_VERSION), date()};
}

static std::string the_command_line = "bounce";

void set_command_line(int argc, const char* const* argv) {
    the_command_line = "bounce";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool plain = word.find_first_of(" \t\n'\"\\$&;|<>*?()`") == std::string::npos && !word.empty();
        the_command_line += plain ? " " + word : " '" + word + "'";
    }
}

const std::string& command_line() {
    return the_command_line;
}

std::string origin_head(const std::vector<Origin>& origins, const std::string& command) {
    std::string text = fmt::format("Written by `{}`.\n", command);
    for (const Origin& origin : origins) {
        text += fmt::format("Commit {}; machine {}", origin.commit, origin.machine);
        if (!origin.renderer.empty()) text += fmt::format("; driver {}, OpenGL {}", origin.renderer, origin.driver);
        text += fmt::format("; date {}.\n", origin.date);
    }
    return text;
}

} // namespace bounce
