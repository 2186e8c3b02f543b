#pragma once
// Sweep files: base values and lists to permute.
//   { "about": "…", "base": {"shadow_maps.resolution": 1024}, "lists": {"direct.normal_offset": [0, 1, 2]} }

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

using ParameterValues = std::vector<std::pair<std::string, std::string>>; ///< "pass.name" → --set text

struct Sweep {
    std::string about;
    ParameterValues base;
    std::vector<std::pair<std::string, std::vector<std::string>>> lists;
    /// Every combination: the base with one value of each list; the last list varies fastest. Without lists: the base.
    std::vector<ParameterValues> combinations() const;
};

/// Throws Error that lists every problem. Finds "name" in assets/sweeps too.
Sweep load_sweep(const std::string& name);

} // namespace bounce
