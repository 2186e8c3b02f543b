#include "app/progress.h"

#include "gpu/timer.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace bounce {

Progress::Progress(std::string what)
    : what_(std::move(what)), start_(steady_seconds()), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
    if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::update(double share) {
    double now = steady_seconds(), elapsed = now - start_;
    if (elapsed < 1 || share <= 0) return;
    double left = elapsed * (1 - share) / share;
    if (terminal_) {
        if (now - shown_ < 0.1) return;
        shown_ = now;
        constexpr int k_width = 30;
        int filled = int(share * k_width);
        std::fputs(fmt::format("\r\033[K{} [{}{}] {:3.0f} %, {:.0f} s left", what_, std::string(size_t(filled), '#'),
                               std::string(size_t(k_width - filled), '.'), 100 * share, left)
                       .c_str(),
                   stderr);
        drawn_ = true;
    } else if (share >= next_line_) {
        std::fputs(fmt::format("{}: {:.0f} %, {:.0f} s left\n", what_, 100 * share, left).c_str(), stderr);
        while (next_line_ <= share)
            next_line_ += 0.25;
    }
    std::fflush(stderr);
}

} // namespace bounce
