#include "app/pass_rows.h"

#include "core/text.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace bounce {

std::vector<PassRow> pass_rows(const GraphModel& model, const Plan& plan) {
    std::vector<PassRow> rows;
    for (size_t i = 0; i < plan.passes.size(); ++i)
        rows.push_back({plan.passes[i].id, int(i), ""});
    std::string before;
    for (const auto& node : model.nodes()) {
        auto skipped = std::find_if(plan.skipped.begin(), plan.skipped.end(),
                                    [&](const PlanSkip& d) { return d.id == node->id(); });
        if (skipped != plan.skipped.end()) {
            auto at = std::find_if(rows.begin(), rows.end(), [&](const PassRow& row) { return row.id == before; });
            rows.insert(at == rows.end() ? rows.begin() : at + 1, {skipped->id, -1, skipped->reason});
        }
        before = node->id();
    }
    return rows;
}

std::string main_output(const Plan& plan, const PlanPass& pass) {
    std::string first;
    for (const PlanSlot& slot : pass.slots) {
        if (!slot.use.writes || slot.resource < 0) continue;
        const PlanResource& resource = plan.resources[size_t(slot.resource)];
        if (resource.is_buffer()) continue;
        if (resource.name().starts_with("out.")) return resource.name();
        if (first.empty()) first = resource.name();
    }
    return first;
}

/// 12000 → "12,000".
static std::string grouped(uint64_t number) {
    std::string digits = std::to_string(number);
    for (int at = int(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(size_t(at), ",");
    return digits;
}

std::string size_text(const PlanResource& resource) {
    if (resource.is_buffer()) return fmt::format("{} × {} B", grouped(resource.count), resource.declaration.stride);
    glm::ivec3 s = resource.texture.size;
    switch (resource.texture.kind) {
    case TextureKind::texture_2d:
        return fmt::format("{}×{}", s.x, s.y);
    case TextureKind::texture_2d_array:
        return fmt::format("{}×{}, {} layer{}", s.x, s.y, s.z, s.z == 1 ? "" : "s");
    case TextureKind::texture_3d:
        break;
    }
    return s.x == s.y && s.y == s.z ? fmt::format("{}³", s.x) : fmt::format("{}×{}×{}", s.x, s.y, s.z);
}

std::string resource_text(const PlanResource& resource) {
    std::string text = resource.is_buffer() ? "buffer" : resource.declaration.format;
    text += " " + size_text(resource);
    if (!resource.is_buffer() && resource.texture.mips > 1) text += fmt::format(", {} mips", resource.texture.mips);
    return text + ", " + format_bytes(double(resource.bytes));
}

static std::string slot_text(const Plan& plan, const PlanSlot& slot) {
    std::string text = slot.bind.resource.empty() ? slot.use.slot : slot.bind.resource;
    if (slot.bind.previous) text = "previous(" + text + ")";
    if (!slot.bind.mip.empty()) text += ", mip " + slot.bind.mip;
    if (!slot.bind.layer.empty()) text += ", layer " + slot.bind.layer;
    if (slot.builtin) return text + ": the scene's";
    if (slot.resource < 0) return text + fmt::format(": not made, reads {}", slot.neutral.x);
    return text + ": " + resource_text(plan.resources[size_t(slot.resource)]);
}

std::string pass_details(const GraphModel& model, const Plan& plan, const PlanPass& pass) {
    const PassNode& node = *model.nodes()[size_t(pass.node)];
    std::string out = pass.id;
    if (node.entry.type != pass.id) out += fmt::format(" ({})", node.entry.type);
    if (!node.entry.shader.empty()) out += ", " + node.entry.shader;
    int steps = pass.repeat_to - pass.repeat_from;
    if (steps != 1) out += fmt::format(", {} steps", steps);
    auto list = [&](const char* title, auto wanted) {
        bool first = true;
        for (const PlanSlot& slot : pass.slots) {
            if (!wanted(slot.use)) continue;
            if (std::exchange(first, false)) out += std::string("\n") + title;
            out += "\n    " + slot_text(plan, slot);
        }
    };
    list("reads", [](const SlotUse& use) { return use.reads && !use.writes; });
    list("updates", [](const SlotUse& use) { return use.reads && use.writes; });
    list("writes", [](const SlotUse& use) { return use.writes && !use.reads; });
    if (!pass.clears.empty()) {
        std::vector<std::string> names;
        for (int clear : pass.clears)
            names.push_back(plan.resources[size_t(clear)].name());
        out += "\ncleared before it: " + join(names, ", ");
    }
    if (pass.barriers) out += "\nbarrier before it: " + barrier_text(pass.barriers);
    if (steps > 1 && pass.step_barriers) out += "\nbarrier between steps: " + barrier_text(pass.step_barriers);
    return out;
}

} // namespace bounce
