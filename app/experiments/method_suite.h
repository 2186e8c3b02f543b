#pragma once
// A chart of all methods: a file of assets/sweeps that names scenes, groups of methods that are held to the same
// reference, and for each method a ladder of settings from the cheapest to the best.
//   { "about": "…", "warm_up": 1, "frames": 2, "noise": 0.03, "quick_noise": 0.05, "metric": "relative_rmse",
//     "scenes": [{"shot": "sponza", "requires": "sponza/Sponza.gltf", "size": [96, 54], "quick_size": [64, 36],
//                 "quick_rungs": 1, "quick_groups": ["one_bounce"], "sky": true, "moves": false, "seen": "…"}],
//     "groups": [{"name": "one_bounce", "title": "one bounce of diffuse light", "compare": ["out.indirect_diffuse"],
//                 "bounces": 1, "diffuse_only": true, "scenes": ["cornell"],
//                 "methods": [{"graph": "lrsm", "kind": "published", "ladder": [{"gather.spiral_cones": 8}, {}]}]}] }
// noise: of the reference, in what is compared.
// quick_rungs: how many of each ladder's first settings a quick chart takes (0: it leaves the scene out). A group
// without "scenes" is measured on all. "seen": what the eye finds in the gallery's pictures.

#include "app/experiments/chart_point.h"
#include "app/experiments/sweep.h"

namespace bounce {

/// The sweep of `bounce chart --all`.
inline constexpr const char* k_all_methods = "all_methods";

struct MethodScene {
    std::string shot, required_scene, seen;
    glm::ivec2 size{96, 54}, quick_size{64, 36};
    int quick_rungs = 1;
    std::vector<std::string> quick_groups; ///< empty: all
    bool sky = false, moves = false;
};

struct MethodLadder {
    std::string graph;
    std::string kind; ///< published, tuned or traced
    std::vector<ParameterValues> rungs;
};

struct MethodGroup {
    std::string name, title;
    std::vector<std::string> parts;
    std::optional<int> bounces;
    std::optional<bool> diffuse_only;
    std::vector<std::string> scenes; ///< empty: all
    std::vector<MethodLadder> methods;

    /// Whether the point was compared as this group's are, and is of one of its graphs.
    bool holds(const ChartPoint& point) const;
};

struct MethodSuite {
    std::string about, metric = k_default_error;
    std::string json = "{}"; ///< the whole file's, without comments
    int warm_up = 1, frames = 2;
    double noise = 0.03, quick_noise = 0.05;
    std::vector<MethodScene> scenes;
    std::vector<MethodGroup> groups;

    /// Scene by scene. Of `shots` alone, unless it is empty; throws Error when one is no scene of the suite. `skipped`
    /// gets a line for each scene that is not on the search path.
    std::vector<PointTask> tasks(bool quick, const std::vector<std::string>& shots,
                                 std::vector<std::string>& skipped) const;
    /// published, tuned or traced; "" of a graph that is in no group.
    std::string kind_of(const std::string& graph) const;
};

/// Throws Error that lists every problem. Finds "name" in assets/sweeps too.
MethodSuite load_method_suite(const std::string& name);

/// Whether the JSON of a sweep's file is one of these.
bool is_method_suite(const std::filesystem::path& path);

} // namespace bounce
