#include "graph/pass.h"

#include <algorithm>

namespace bounce {

ResourceDeclaration& Declaration::creates(const std::string& name, ResourceKind kind, const std::string& format,
                                          Extent extent) {
    ResourceDeclaration resource;
    resource.name = name;
    resource.kind = kind;
    resource.format = format;
    resource.size = std::move(extent);
    resource.radiance = holds_radiance(name);
    resources_.push_back(std::move(resource));
    return resources_.back();
}

ResourceDeclaration& Declaration::creates_buffer(const std::string& name, const std::string& count, int stride) {
    ResourceDeclaration resource;
    resource.name = name;
    resource.kind = ResourceKind::buffer;
    resource.count = count;
    resource.stride = stride;
    resources_.push_back(std::move(resource));
    return resources_.back();
}

void Declaration::uses(const std::string& program) {
    programs_.push_back(program);
    for (const ShaderSlot& slot : slots_of_(program)) {
        Usage usage = slot.kind == SlotKind::sampled ? Usage::sampled
                      : slot.kind == SlotKind::image ? Usage::image
                                                     : Usage::storage;
        auto known = std::find_if(uses_.begin(), uses_.end(),
                                  [&](const SlotUse& u) { return u.slot == slot.name && u.usage == usage; });
        if (known != uses_.end()) {
            known->reads = known->reads || slot.reads;
            known->writes = known->writes || slot.writes;
            known->optional = known->optional && slot.optional;
            if (!known->neutral) known->neutral = slot.neutral;
            if (known->required_if.empty()) known->required_if = slot.required_if;
        } else {
            uses_.push_back(
                {slot.name, usage, slot.reads, slot.writes, slot.optional, slot.where, slot.neutral, slot.required_if});
        }
    }
}

static std::vector<PassType>& registry() {
    static std::vector<PassType> types;
    return types;
}

const std::vector<PassType>& pass_types() {
    return registry();
}

bool register_pass(PassType type) {
    auto& types = registry();
    auto at = std::lower_bound(types.begin(), types.end(), type, [](auto& a, auto& b) { return a.name < b.name; });
    types.insert(at, std::move(type));
    return true;
}

} // namespace bounce
