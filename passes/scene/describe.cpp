#include "scene/describe.h"

#include "core/text.h"
#include "scene/extent.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace bounce {

namespace {

std::string with_commas(size_t n) {
    std::string digits = fmt::to_string(n);
    for (size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return digits;
}

/// In the file's coordinates. Far from the origin the corners need more digits to differ.
std::string box(const Bounds& bounds, const LoadedSpace& space) {
    if (bounds.empty()) return "empty";
    glm::dvec3 min = space.to_file(bounds.min), max = space.to_file(bounds.max), size = max - min;
    int digits = space.origin == glm::dvec3(0) ? 4 : 10;
    return fmt::format("{:.4g} × {:.4g} × {:.4g} m, from ({:.{}g}, {:.{}g}, {:.{}g}) to ({:.{}g}, {:.{}g}, {:.{}g})",
                       size.x, size.y, size.z, min.x, digits, min.y, digits, min.z, digits, max.x, digits, max.y,
                       digits, max.z, digits);
}

std::string space_line(const LoadedSpace& space) {
    std::string out;
    if (space.origin != glm::dvec3(0))
        out = fmt::format("relative to ({:.10g}, {:.10g}, {:.10g})", space.origin.x, space.origin.y, space.origin.z);
    if (space.unit != 1) out += fmt::format("{}in units of {:.4g} m", out.empty() ? "" : ", ", space.unit);
    return out + ", because floats hold seven digits";
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
    sort(facts.alpha_tested_materials + facts.blended_materials > 0, "alpha tests",
         "no alpha-tested or blended material");
    sort(facts.dynamic_instances > 0, "updates of geometry each frame", "no geometry moves");
    sort(facts.animated_lights, "updates of light each frame", facts.lights() ? "no light moves" : "no lights");
}

/// The names of the used materials that are blended.
std::vector<std::string> blended_materials(const Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[size_t(node.mesh)].primitives)
            used[size_t(primitive.material)] = true;
    }
    std::vector<std::string> names;
    for (size_t m = 0; m < used.size(); ++m)
        if (used[m] && scene.materials[m].alpha_mode == AlphaMode::blend) names.push_back(scene.materials[m].name);
    return names;
}

/// Which materials are blended, and how far from the truth each kind of graph takes them.
void add_blended(const Scene& scene, const std::function<void(const char*, const std::string&)>& line) {
    std::vector<std::string> names = blended_materials(scene);
    if (names.empty()) return;
    constexpr size_t k_named = 8;
    std::string more = names.size() > k_named ? fmt::format(" and {} more", names.size() - k_named) : "";
    if (names.size() > k_named) names.resize(k_named);
    line("blended", join(names, ", ") + more);
    line("  reference", "each ray passes a surface with probability 1 − alpha (camera, shadow and bounce rays)");
    line("  all graphs", "G-buffer, shadow maps and reflective shadow maps hold it in a share alpha of their texels, "
                         "by a hash of texel and triangle: right in the mean, with grain");
    line("  ldm graphs", "layered depth maps hold it in a share alpha of their texels, likewise");
    line("  voxels",
         "lrsm, dvs, vct and voxel_ao hold it in a share alpha of the voxel columns across it, by a hash of "
         "column and draw: layers of one draw nearer than 4 voxels count as one");
    line("  edge mask", "takes a surface as there from alpha 0.5 on");
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
    line("materials", fmt::format("{} used: {} glossy, {} emissive, {} alpha-tested, {} blended", facts.materials,
                                  facts.glossy_materials, facts.emissive_materials, facts.alpha_tested_materials,
                                  facts.blended_materials));
    add_blended(shot.scene, line);
    line("model", shot.diffuse_only ? "Lambert: the shot is diffuse only"
                                    : std::string(k_material_models[size_t(shot.material_model)]));
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
    const LoadedSpace& space = shot.scene.space;
    line("bounds", box(facts.bounds, space));
    if (facts.dynamic_instances > 0) line("  over time", box(facts.bounds_over_animation, space));
    if (std::string strays = describe_strays(facts); !strays.empty()) {
        line("  in all", box(facts.whole_bounds, space));
        line("  left out", strays);
    }
    if (!(space == LoadedSpace{})) line("loaded", space_line(space));

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
