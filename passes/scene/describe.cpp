#include "scene/describe.h"

#include "core/text.h"
#include "scene/extent.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

namespace {

std::string with_commas(size_t n) {
    std::string digits = fmt::to_string(n);
    for (size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return digits;
}

std::string box(const Bounds& bounds) {
    if (bounds.empty()) return "empty";
    glm::vec3 size = bounds.size();
    return fmt::format("{:.4g} × {:.4g} × {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})", size.x,
                       size.y, size.z, bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y,
                       bounds.max.z);
}

std::string light_line(const SceneFacts& facts) {
    if (facts.lights() == 0) return "none";
    std::vector<std::string> kinds;
    if (facts.point_lights) kinds.push_back(fmt::format("{} point", facts.point_lights));
    if (facts.spot_lights) kinds.push_back(fmt::format("{} spot", facts.spot_lights));
    if (facts.directional_lights) kinds.push_back(fmt::format("{} directional", facts.directional_lights));
    return join(kinds, ", ") + (facts.animated_lights ? " (moving)" : "");
}

/// "needs" and "does not need": what a graph may leave out, in words.
void add_needs(const SceneFacts& facts, const Shot& shot, std::vector<std::string>& needs,
               std::vector<std::string>& not_needs) {
    auto sort = [&](bool needed, const char* what, const char* why_not) {
        if (needed)
            needs.emplace_back(what);
        else
            not_needs.push_back(fmt::format("{} ({})", what, why_not));
    };
    sort(facts.lights() > 0, "shadow maps and direct light", "no lights");
    sort(facts.emissive_materials > 0, "light from emissive surfaces", "no emissive material");
    sort(facts.environment, "environment light", "no environment");
    sort(facts.glossy_materials > 0, "specular reflection",
         shot.diffuse_only ? "the shot is diffuse only" : "no glossy material");
    sort(facts.alpha_tested_materials > 0, "alpha tests", "no alpha-tested material");
    sort(facts.dynamic_instances > 0, "updates of geometry each frame", "no geometry moves");
    sort(facts.animated_lights, "updates of light each frame", facts.lights() ? "no light moves" : "no lights");
}

} // namespace

std::string describe_strays(const SceneFacts& facts) {
    float kept = longest_edge(facts.bounds_over_animation), whole = longest_edge(facts.whole_bounds);
    if (!(whole > kept)) return "";
    std::string what = facts.stray_triangles == 0   ? "moving geometry strays"
                       : facts.stray_triangles == 1 ? "1 triangle strays"
                                                    : with_commas(facts.stray_triangles) + " triangles stray";
    return fmt::format("{} {:.3g} times as far as the rest reaches; voxel grids, layered depth maps, shadow maps of "
                       "directional lights and lengths in diagonals leave that out",
                       what, double(whole) / double(std::max(kept, 1e-30f)));
}

std::string describe_scene(const Shot& shot) {
    SceneFacts facts = shot_facts(shot);
    std::string out;
    auto line = [&](const char* what, const std::string& value) { out += fmt::format("{:<14}{}\n", what, value); };
    line("scene", fmt::format("{} ({})", shot.name, shot.path.string()));
    line("triangles",
         fmt::format("{} drawn, in {} instances", with_commas(facts.triangles), with_commas(facts.instances)));
    line("vertices", with_commas(facts.vertices));
    line("materials", fmt::format("{} used: {} glossy, {} emissive, {} alpha-tested", facts.materials,
                                  facts.glossy_materials, facts.emissive_materials, facts.alpha_tested_materials));
    line("textures", facts.textures == 0 ? "none"
                                         : fmt::format("{}, {} (8-bit RGBA, without mips)", facts.textures,
                                                       format_bytes(double(facts.texture_bytes))));
    line("lights", light_line(facts));
    line("environment", !facts.environment ? "none"
                        : shot.environment.map.empty()
                            ? "constant"
                            : fmt::format("{} × {} map", shot.environment.map.width, shot.environment.map.height));
    line("animation",
         facts.animation_duration > 0
             ? fmt::format("{:.4g} s, {} of {} instances move{}", facts.animation_duration, facts.dynamic_instances,
                           facts.instances, shot.camera_path.empty() ? "" : ", so does the camera")
             : "none");
    line("bounds", box(facts.bounds));
    if (facts.dynamic_instances > 0) line("  over time", box(facts.bounds_over_animation));
    if (std::string strays = describe_strays(facts); !strays.empty()) {
        line("  in all", box(facts.whole_bounds));
        line("  left out", strays);
    }

    std::vector<std::string> needs, not_needs;
    add_needs(facts, shot, needs, not_needs);
    line("needs", needs.empty() ? "nothing: there is no light" : join(needs, ", "));
    line("does not need", not_needs.empty() ? "–" : join(not_needs, ", "));
    if (shot.scene.notes.empty()) line("skipped", "nothing");
    for (size_t i = 0; i < shot.scene.notes.size(); ++i)
        line(i ? "" : "notes", shot.scene.notes[i]);
    return out;
}

} // namespace bounce
