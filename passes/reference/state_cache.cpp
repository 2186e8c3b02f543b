#include "reference/state_cache.h"

#include "core/error.h"
#include "core/paths.h"
#include "reference/reference_image.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace fs = std::filesystem;

fs::path reference_cache_folder() {
    fs::path folder = cache_folder() / "reference";
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder)) {
        throw Error("cannot create the folder '" + folder.string() + "'" + (error ? ": " + error.message() : ""));
    }
    return folder;
}

static fs::path partial_path(const std::string& key) {
    return reference_cache_folder() / (key + "-partial.state");
}

std::vector<KeptState> kept_states(const std::string& key) {
    std::vector<KeptState> states;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(reference_cache_folder(), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.rfind(key + "-", 0) != 0 || entry.path().extension() != ".state") continue;
        if (auto header = read_state_header(entry.path())) {
            states.push_back({entry.path(), header->samples, header->max_samples});
        }
    }
    std::sort(states.begin(), states.end(), [](const KeptState& a, const KeptState& b) {
        return std::tie(a.samples, a.max_samples, a.path) < std::tie(b.samples, b.max_samples, b.path);
    });
    return states;
}

void keep_state(const ReferenceRender& render, bool partial) {
    render.save_state(partial ? partial_path(render.key())
                              : reference_cache_folder() / fmt::format("{}-{}.state", render.key(), render.samples()));
}

void forget_partial_state(const std::string& key) {
    std::error_code ignored;
    fs::remove(partial_path(key), ignored);
}

void prune_states(uint64_t bytes, const std::string& spare_key) {
    struct File {
        fs::path path;
        fs::file_time_type time;
        uint64_t size;
    };
    std::vector<File> files;
    uint64_t total = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(reference_cache_folder(), ignored)) {
        if (entry.path().extension() != ".state") continue;
        files.push_back({entry.path(), entry.last_write_time(ignored), uint64_t(entry.file_size(ignored))});
        total += files.back().size;
    }
    std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.time < b.time; });
    for (const File& file : files) {
        if (total <= bytes) break;
        if (file.path.filename().string().rfind(spare_key, 0) == 0) continue;
        if (fs::remove(file.path, ignored)) total -= file.size;
    }
}

} // namespace bounce
