// Which passes a pass or a resource that is asked for needs switched on.
#include "core/text.h"
#include "graph/model.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

static bool writes(const PassNode& node, const std::string& resource) {
    for (const auto& program : node.programs) {
        for (const ShaderSlot& slot : program->slots())
            if (slot.writes && node.target_of(slot.name).resource == resource) return true;
    }
    return false;
}

bool GraphModel::is_made(const std::string& resource) const {
    return std::any_of(nodes_.begin(), nodes_.end(), [&](auto& n) { return n->enabled && writes(*n, resource); });
}

/// Those of `open` that are off, and, of what they read and no pass that is on makes, those that would.
std::vector<std::string> GraphModel::off_among(std::vector<const PassNode*> open) const {
    std::vector<std::string> ids;
    for (size_t i = 0; i < open.size(); ++i) {
        const PassNode& node = *open[i];
        if (!node.enabled) ids.push_back(node.id());
        for (const auto& program : node.programs) {
            for (const ShaderSlot& slot : program->slots()) {
                std::string resource = node.target_of(slot.name).resource;
                if (!slot.reads || slot.writes || is_made(resource)) continue;
                for (const auto& maker : nodes_) {
                    bool known = std::find(open.begin(), open.end(), maker.get()) != open.end();
                    if (!known && writes(*maker, resource)) open.push_back(maker.get());
                }
            }
        }
    }
    return ids;
}

std::vector<std::string> GraphModel::off_before(const std::string& id) const {
    const PassNode* node = find_node(id);
    return node ? off_among({node}) : std::vector<std::string>();
}

std::vector<std::string> GraphModel::off_for(const std::string& resource) const {
    std::vector<const PassNode*> makers;
    for (const auto& node : nodes_)
        if (writes(*node, resource)) makers.push_back(node.get());
    return is_made(resource) ? std::vector<std::string>() : off_among(makers);
}

void GraphModel::switch_pass(const std::string& id, bool on) {
    PassNode* node = find_node(id);
    if (!node) {
        std::vector<std::string> names;
        for (const auto& known : nodes_)
            names.push_back(known->id());
        throw Error(fmt::format("graph '{}' has no pass '{}'{}", file_.name, id, did_you_mean(id, names)));
    }
    if (!on) node->enabled = false;
    for (const std::string& off : on ? off_before(id) : std::vector<std::string>())
        find_node(off)->enabled = true;
}

} // namespace bounce
