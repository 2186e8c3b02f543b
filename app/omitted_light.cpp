#include "app/omitted_light.h"

#include "core/asset_files.h"
#include "core/error.h"
#include "core/log.h"
#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <set>

namespace bounce {

std::vector<std::string> omitted_light(const Transport& transport, const SceneFacts& facts) {
    const auto has = [&](const char* part) {
        return std::find(transport.parts.begin(), transport.parts.end(), part) != transport.parts.end();
    };
    std::vector<std::string> omitted;
    if (transport.bounces == 0 || has("out.radiance")) return omitted;
    if (facts.emissive_materials > 0 && !has("out.emitted"))
        omitted.emplace_back("light of emissive surfaces on others");
    if (facts.environment && !has("out.environment")) omitted.emplace_back("light of the environment");
    return omitted;
}

void log_omitted_light(const std::string& graph, const Transport& transport, const SceneFacts& facts) {
    const std::vector<std::string> omitted = omitted_light(transport, facts);
    if (omitted.empty()) return;
    static std::mutex mutex;
    static std::set<std::string> told;
    const std::string text = fmt::format("graph '{}' leaves out {}", graph, join(omitted, " and "));
    const std::lock_guard lock(mutex);
    if (told.insert(text).second) spdlog::info("{}", text);
}

std::string describe_omitted_light(const SceneFacts& facts) {
    std::map<std::string, std::vector<std::string>> graphs;
    for (const std::string& name : asset_names("graphs")) {
        try {
            for (const std::string& light : omitted_light(read_graph_file(find_graph(name)).transport, facts))
                graphs[light].push_back(name);
        } catch (const Error&) {
            // A file that cannot be read is told by who opens it.
        }
    }
    std::string out;
    for (const auto& [light, names] : graphs)
        out += fmt::format("{:<14}{} is left out by {}\n", out.empty() ? "left out" : "", light, join(names, ", "));
    return out;
}

} // namespace bounce
