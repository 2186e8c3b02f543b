// Prints a plan as text and as Graphviz.
#include "core/text.h"
#include "gpu/barrier.h"
#include "graph/model.h"

#include <fmt/format.h>

namespace bounce {

static std::string shape_text(const PlanResource& resource) {
    const ResourceDeclaration& d = resource.declaration;
    if (resource.is_buffer()) return fmt::format("buffer {} × {} B", resource.count, d.stride);
    glm::ivec3 s = resource.texture.size;
    std::string size =
        d.kind == ResourceKind::texture_2d ? fmt::format("{}×{}", s.x, s.y) : fmt::format("{}×{}×{}", s.x, s.y, s.z);
    std::string mips = resource.texture.mips > 1 ? fmt::format(", {} mips", resource.texture.mips) : "";
    return fmt::format("{} {} {}{}", to_string(d.kind), d.format, size, mips);
}

static std::string slot_text(const Plan& plan, const PlanSlot& slot) {
    std::string text = slot.bind.previous ? "previous(" + slot.bind.resource + ")" : slot.bind.resource;
    if (!slot.bind.mip.empty()) text += " mip " + slot.bind.mip;
    if (!slot.bind.layer.empty()) text += " layer " + slot.bind.layer;
    if (slot.use.slot != slot.bind.resource) text += " as " + slot.use.slot;
    if (slot.builtin) return text;
    if (slot.resource < 0) {
        bool dark = slot.neutral == glm::vec4(0);
        return text + (dark ? " (neutral 0)" : fmt::format(" (neutral {})", slot.neutral.x));
    }
    return fmt::format("{} ({})", text, format_bytes(double(plan.resources[size_t(slot.resource)].bytes)));
}

std::string plan_text(const GraphModel& model, const Plan& plan) {
    std::string out =
        fmt::format("graph {} at {}×{}: {} passes, {} resources, {}\n", model.file().name, plan.size.x, plan.size.y,
                    plan.passes.size(), plan.resources.size(), format_bytes(double(plan.total_bytes())));
    if (!model.file().about.empty()) out += model.file().about + "\n";
    int number = 0;
    for (const PlanPass& pass : plan.passes) {
        const PassNode& node = *model.nodes()[size_t(pass.node)];
        out += fmt::format("\n{:2}. {}", ++number, pass.id);
        if (node.entry.type != pass.id)
            out += fmt::format(" ({}{})", node.entry.type, node.entry.shader.empty() ? "" : " " + node.entry.shader);
        if (pass.repeat_to - pass.repeat_from != 1)
            out += fmt::format(", steps {} … {}", pass.repeat_from, pass.repeat_to - 1);
        if (!pass.loop.empty()) out += fmt::format(", in the loop '{}'", pass.loop);
        out += "\n";
        if (pass.programs.size() > 1) {
            out += "      runs    ";
            for (const std::string& program : pass.programs)
                out += program + (program == pass.programs.back() ? "\n" : ", ");
        }
        if (pass.barriers) out += "      barrier " + barrier_text(pass.barriers) + "\n";
        if (pass.step_barriers && pass.repeat_to - pass.repeat_from > 1)
            out += "      between steps " + barrier_text(pass.step_barriers) + "\n";
        for (int clear : pass.clears)
            out += "      clears  " + plan.resources[size_t(clear)].name() + "\n";
        for (const PlanSlot& slot : pass.slots) {
            if (slot.use.reads && !slot.use.writes) out += "      reads   " + slot_text(plan, slot) + "\n";
        }
        for (const PlanSlot& slot : pass.slots) {
            if (slot.use.writes)
                out += std::string(slot.use.reads ? "      updates " : "      writes  ") + slot_text(plan, slot) + "\n";
        }
    }
    if (!plan.skipped.empty()) out += "\nskipped (what the scene does not need is not computed):\n";
    for (const PlanSkip& skipped : plan.skipped)
        out += fmt::format("    {}: {}\n", skipped.id, skipped.reason);
    out += "\nresources:\n";
    for (const PlanResource& resource : plan.resources) {
        std::string flags = resource.declaration.persistent    ? ", persistent"
                            : resource.declaration.incremental ? ", incremental"
                                                               : "";
        if (resource.needs_previous) flags += ", with last frame's copy";
        out += fmt::format("    {:<28} {:<44} {:>14} bytes{}\n", resource.name(), shape_text(resource),
                           resource.total_bytes(), flags);
    }
    out += fmt::format("    {:<28} {:<44} {:>14} bytes\n", "total", "", plan.total_bytes());
    return out;
}

/// Inside the quotes of a label.
static std::string quoted(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string plan_graphviz(const GraphModel& model, const Plan& plan) {
    std::string out =
        fmt::format("digraph \"{}\" {{\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n", quoted(model.file().name));
    for (const PlanPass& pass : plan.passes)
        out +=
            fmt::format("  \"pass {0}\" [label=\"{0}\", shape=box, style=filled, fillcolor=\"#ffe0a0\"];\n", pass.id);
    for (const PlanSkip& skipped : plan.skipped) {
        out += fmt::format("  \"pass {0}\" [label=\"{0}\\n{1}\", shape=box, style=dashed];\n", skipped.id,
                           quoted(skipped.reason));
    }
    for (const PlanResource& resource : plan.resources) {
        out += fmt::format("  \"{}\" [label=\"{}\\n{}\\n{}\", shape=ellipse];\n", resource.name(), resource.name(),
                           shape_text(resource), format_bytes(double(resource.total_bytes())));
    }
    for (const PlanPass& pass : plan.passes) {
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource < 0) continue;
            const std::string& name = plan.resources[size_t(slot.resource)].name();
            if (slot.use.reads)
                out += fmt::format("  \"{}\" -> \"pass {}\"{};\n", name, pass.id,
                                   slot.bind.previous ? " [style=dotted]" : "");
            if (slot.use.writes) out += fmt::format("  \"pass {}\" -> \"{}\";\n", pass.id, name);
        }
    }
    return out + "}\n";
}

} // namespace bounce
