#pragma once
// Cases of the stability suite (assets/stability/*.json): a small scene or a shot, a ladder of one number, what is
// measured on each rung, and the mark that a method has to reach. Each is about one way in which methods fail.
//   { "about": "…", "ladder": {"wall": [0.25, 1, 4]}, "unit": "voxels of wall", "names": {"t": "=wall * 0.07"},
//     "scenes": {"room": [{"quad": [[…], […], […], […]], "colour": 0.7, "if": "=!open"}, {"box": [[…], […]]}]},
//     "shot": {"camera": …, "lights": […]}, "set": {"voxelization.resolution": 64},
//     "quantity": "share", "against": {"open": 1}, "resource": "out.indirect_diffuse", "size": [32, 32], "most": 0.03 }
// A text that begins with = is an expression of the ladder's number, of `names` in their order, and of `bounces` (what
// the graph models; −1: all). {"repeat": "=n", "of": {…}} in a list stands for n elements, with `i` from 0 on.
// Parts of a scene: "quad" and "box" with "colour", "emission", "roughness", "metallic"; {"name": "block", "parts":
// […]} and {"instance": "block", "position": […], "scale": […]}, or "copy" for one with a mesh of its own. The first
// scene is the shot's; its objects may name others. "set" holds for the graphs that have such a parameter.

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

enum class StabilityQuantity {
    share,      ///< the resource's sum, as a share of that with the names of `against`
    difference, ///< RMS of the difference from the picture with the names of `against`, over that picture's mean
    flicker,    ///< RMS of the second difference from frame to frame, over the mean (flicker.h)
    flip,       ///< FLIP over time (flicker.h)
    error,      ///< RMSE against the reference of the graph's transport, over its mean
    bias,       ///< the mean against that reference's
    mean,       ///< the mean against `expected`
    time        ///< milliseconds a frame
};

/// What of the ladder is held to the mark.
enum class StabilitySummary { worst, first, last, growth /**< the last over the first */ };

struct StabilityCase {
    std::string name, about, unit, step; ///< step: the ladder's name
    std::string text;                    ///< the whole file, as compact JSON
    std::vector<double> ladder;
    StabilityQuantity quantity = StabilityQuantity::error;
    StabilitySummary summary = StabilitySummary::worst;
    double most = 0; ///< the mark: the figure's size must not be above it
    std::string resource = "out.indirect_diffuse", expected;
    glm::ivec2 size{32};
    int frames = 1, samples = 256;
    std::optional<bool> diffuse_only; ///< of the reference, instead of what the graph models
    nlohmann::ordered_json names, scenes, shot, sets, against;
};

std::vector<std::string> stability_case_names();
/// A path, or a name of assets/stability. Throws Error that lists every problem.
StabilityCase load_stability_case(const std::string& name);

/// Whether it compares frames with the next ones.
bool is_over_time(StabilityQuantity quantity);
/// "share", "worst", …: as files and tables name them.
const char* name_of(StabilityQuantity quantity);
const char* name_of(StabilitySummary summary);
/// "3.2 %", "14 ms", "1.9 ×".
std::string stability_text(const StabilityCase& which, double value, bool summarised);

} // namespace bounce
