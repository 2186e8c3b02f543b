#include "app/print.h"

#include "core/printable.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace bounce {

static int g_output_error = 0; ///< errno of the first write to standard output that failed

void prepare_streams() {
    for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) (void)!::open("/dev/null", O_RDWR);
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void print_text(std::FILE* stream, std::string_view text) {
    const std::string shown = printable(text);
    errno = 0;
    const bool written = std::fwrite(shown.data(), 1, shown.size(), stream) == shown.size();
    if (!written && stream == stdout && g_output_error == 0) g_output_error = errno ? errno : EIO;
    std::clearerr(stream);
}

std::string output_problem() {
    errno = 0;
    if (std::fflush(stdout) != 0 && g_output_error == 0) g_output_error = errno ? errno : EIO;
    if (g_output_error == 0 || g_output_error == EPIPE) return {};
    return std::error_code(g_output_error, std::generic_category()).message();
}

} // namespace bounce
