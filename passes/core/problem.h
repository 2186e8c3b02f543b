#pragma once
// What an exception of any kind says to a person.

#include <exception>
#include <string>

namespace bounce {

/// An Error as it is; of others the plain words: "out of memory", a file system's reason with its paths, what is wrong
/// with JSON text.
std::string problem_text(const std::exception& problem);

} // namespace bounce
