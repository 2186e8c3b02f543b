#pragma once
// What commands print. A full disk or a closed pipe behind it never costs the work that is being done: it is told when
// all is done.

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <string_view>

namespace bounce {

/// Makes the streams safe to print to: descriptors 0, 1 and 2 are open (else the next file opened would take their
/// place), and a reader that went away or a limit on file sizes fails a write, not the program. Call first of all.
void prepare_streams();

/// As UTF-8 without control characters. Does not throw; see output_problem.
void print_text(std::FILE* stream, std::string_view text);

template <class... T>
void print(fmt::format_string<T...> format, T&&... values) {
    print_text(stdout, fmt::format(format, std::forward<T>(values)...));
}
template <class... T>
void print_error(fmt::format_string<T...> format, T&&... values) {
    print_text(stderr, fmt::format(format, std::forward<T>(values)...));
}

/// Flushes standard output. Why not all of it could be written; "" when it was, and when nobody reads it any more.
std::string output_problem();

} // namespace bounce
