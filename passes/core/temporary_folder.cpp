#include "core/temporary_folder.h"

#include "core/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace bounce {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path shared = std::filesystem::temp_directory_path(error);
    std::string pattern = ((error ? std::filesystem::path("/tmp") : shared) / "bounce-XXXXXX").string();
    if (!::mkdtemp(pattern.data()))
        throw Error(fmt::format("cannot make a folder '{}': {}", pattern, std::strerror(errno)));
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace bounce
