#include "core/asset_files.h"

#include "core/error.h"
#include "core/paths.h"
#include "core/text.h"

#include <algorithm>

namespace bounce {

namespace fs = std::filesystem;

std::vector<std::string> asset_names(const std::string& kind) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(assets_folder() / kind, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

fs::path find_asset(const std::string& kind, const std::string& what, const std::string& name) {
    std::error_code ignored;
    for (const fs::path& path : {fs::path(name), assets_folder() / kind / (name + ".json")})
        if (fs::is_regular_file(path, ignored)) return path;
    throw Error("there is no " + what + " '" + name + "'" + did_you_mean(name, asset_names(kind)));
}

} // namespace bounce
