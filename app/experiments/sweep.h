#pragma once
// Sweep files: base values and lists to permute.
//   { "about": "…", "base": {"shadow_maps.resolution": 1024}, "lists": {"direct.normal_offset": [0, 1, 2]},
//     "each": {"direct.filter_radius": [1, 2]} }
// Lists are permuted with one another; the values of `each` are tried one by one on top of the base. Besides:
//   "enable": ["accumulate"], "disable": ["shadows"]   passes to switch in every point
//   "metric": "flip"                                   by which the chart draws errors

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

using ParameterValues = std::vector<std::pair<std::string, std::string>>; ///< "pass.name" → --set text

struct Sweep {
    std::string about;
    std::string metric;                                 ///< "": the chart's default
    std::vector<std::pair<std::string, bool>> switches; ///< pass → on or off
    ParameterValues base;
    std::vector<std::pair<std::string, std::vector<std::string>>> lists;
    std::vector<std::pair<std::string, std::vector<std::string>>> each;
    /// Every combination: the base with one value of each list; the last list varies fastest. Without lists: the base.
    /// Then, for every value of `each`, the base with that value alone.
    std::vector<ParameterValues> combinations() const;
};

/// Throws Error that lists every problem. Finds "name" in assets/sweeps too.
Sweep load_sweep(const std::string& name);

} // namespace bounce
