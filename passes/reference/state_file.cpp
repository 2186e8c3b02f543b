// The state of a render on disk: one line that names the format, one of JSON, then the sums of both halves as they lie
// in memory.

#include "core/error.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/limits.h"
#include "reference/render.h"

#include <cstring>
#include <fstream>

namespace bounce {

static const std::string k_magic = "bounce reference state 1\n";

static ReferenceRender::Checkpoint checkpoint_of(const nlohmann::json& json) {
    return {json.at("samples").get<int>(), json.at("noise").get<std::map<std::string, double>>()};
}

void ReferenceRender::save_state(const std::filesystem::path& path) const {
    nlohmann::json header;
    header["key"] = key_;
    header["width"] = width_;
    header["height"] = height_;
    header["channels"] = k_reference_channels;
    header["samples"] = samples();
    header["max_samples"] = max_samples();
    for (const Tile& tile : tiles_)
        header["tiles"].push_back(tile.samples);
    header["history"] = nlohmann::json::array();
    for (const Checkpoint& checkpoint : history_) {
        header["history"].push_back({{"samples", checkpoint.samples}, {"noise", checkpoint.relative_noise}});
    }
    std::string bytes = k_magic + header.dump() + "\n";
    const size_t header_size = bytes.size(), half_size = sums_[0].size() * sizeof(float);
    bytes.resize(header_size + 2 * half_size);
    for (size_t h = 0; h < 2; ++h)
        std::memcpy(bytes.data() + header_size + h * half_size, sums_[h].data(), half_size);
    write_file_atomically(path, bytes);
}

void ReferenceRender::load_state(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, k_max_state_bytes);
    auto fail = [&path](const std::string& why) -> void {
        throw Error("cannot resume from '" + path.string() + "': " + why);
    };
    const size_t line_end = bytes.find('\n', k_magic.size());
    if (bytes.compare(0, k_magic.size(), k_magic) != 0 || line_end == std::string::npos) {
        fail("it is not the state of a reference render");
    }
    std::vector<int> counts;
    std::vector<Checkpoint> history;
    nlohmann::json header;
    try {
        header = parse_json(std::string_view(bytes).substr(k_magic.size(), line_end - k_magic.size()), path.string());
    } catch (const Error&) {
        fail("its header is damaged");
    }
    try {
        if (header.at("key") != key_) fail("it belongs to another shot, to other settings or to another version");
        counts = header.at("tiles").get<std::vector<int>>();
        for (const auto& entry : header.at("history")) {
            history.push_back(checkpoint_of(entry));
        }
    } catch (const nlohmann::json::exception&) {
        fail("its header is damaged");
    }
    const size_t half_size = sums_[0].size() * sizeof(float);
    if (counts.size() != tiles_.size() || bytes.size() != line_end + 1 + 2 * half_size) {
        fail("it is damaged: its size is not what its header says");
    }
    for (size_t i = 0; i < tiles_.size(); ++i) {
        if (counts[i] < 0) fail("it is damaged: a negative number of samples");
    }
    for (size_t i = 0; i < tiles_.size(); ++i)
        tiles_[i].samples = counts[i];
    history_ = std::move(history);
    for (size_t h = 0; h < 2; ++h)
        std::memcpy(sums_[h].data(), bytes.data() + line_end + 1 + h * half_size, half_size);
}

std::optional<ReferenceRender::StateHeader> read_state_header(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string magic, line;
    if (!std::getline(file, magic) || magic + "\n" != k_magic || !std::getline(file, line)) return std::nullopt;
    try {
        const auto json = parse_json(line, path.string());
        ReferenceRender::StateHeader header;
        header.key = json.at("key").get<std::string>();
        header.samples = json.at("samples").get<int>();
        header.max_samples = json.at("max_samples").get<int>();
        for (const auto& entry : json.at("history"))
            header.history.push_back(checkpoint_of(entry));
        return header;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

} // namespace bounce
