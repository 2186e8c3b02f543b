#pragma once
// A graph file (assets/graphs/*.json): an ordered list of passes with what differs from their defaults. It may start
// from another (`extends`; graph_overlay.h); here it is whole. passes/graph/README.md is the reference.
//
//   { "version": 1, "about": "…",
//     "transport": {"bounces": 0, "diffuse_only": false, "parts": ["out.direct", "out.emission"],
//                   "occlusion_distance": "ao.d_max", "occlusion_falloff": "ao.falloff"},
//     "parameters": { "scale": {"default": 0.5, "range": [0.1, 1], "unit": "", "help": "…"} },
//     "resources":  { "blur.half": {"kind": "texture_2d", "format": "rgba16f", "size": ["width*graph.scale",
//     "height*graph.scale"],
//                                   "mips": 1, "persistent": false, "clear": true, "radiance": false, "neutral":
//                                   [0,0,0,0]},
//                     "list.nodes": {"kind": "buffer", "count": "width*height*8", "stride": 16} },
//     "passes": [ { "id": "blur", "type": "compute", "shader": "blur.comp", "params": {"radius": 3},
//                   "bind": {"blur.source": "out.direct", "blur.target": {"resource": "blur.half", "mip":
//                   "iteration"}}, "dispatch": "blur.half", "repeat": {"over": "mips", "of": "blur.half", "from": 1,
//                   "loop": "name"}, "params_of": "other", "enabled": true, "needs": "emissive_materials ||
//                   environment" } ] }

#include "core/parameters.h"
#include "graph/resource.h"

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bounce {

/// Where a slot points: a whole resource, or one mip or layer of it (expressions that may use `iteration`).
struct BindEntry {
    std::string resource;
    std::string mip, layer; ///< empty = all
    bool previous = false;  ///< last frame's copy
};

struct RepeatEntry {
    std::string over; ///< "", "count", "mips", "layers", "lights", "views", "loop"
    std::string of;   ///< resource for mips and layers
    std::string count = "1";
    std::string from = "0";
    std::string loop; ///< passes in a row that name the same one take their steps together
};

struct DispatchEntry {
    std::string resource;             ///< one thread a texel of it
    std::vector<std::string> threads; ///< or so many threads
    std::string indirect;             ///< or group counts read from this buffer
};

struct NodeEntry {
    std::string id, type, shader;
    std::map<std::string, std::string> params_json; ///< value as JSON text
    std::string params_of; ///< an earlier pass: shader parameters that it has too are its own, not this pass's
    std::map<std::string, BindEntry> bind;
    DispatchEntry dispatch;
    RepeatEntry repeat;
    std::string needs; ///< expression; 0: the pass is not needed
    bool enabled = true;
};

/// The light transport that a graph models, so that it is held to a reference of the same.
struct Transport {
    int bounces = -1; ///< scattering orders after direct; −1 = all
    bool diffuse_only = false;
    bool diffuse_secondary = false;                 ///< surfaces behind the visible one have their diffuse lobe alone
    std::vector<std::string> parts{"out.radiance"}; ///< the parts that it makes; their sum is what is compared
    /// Parameters ("id.name") that say what out.ambient_occlusion_dmax means: d_max as a share of the scene's diagonal,
    /// and a choice of k_occlusion_falloffs; "" = the reference's defaults.
    std::string occlusion_distance, occlusion_falloff;
};

struct GraphFile {
    std::string name; ///< file name without extension
    std::filesystem::path path;
    std::string about;
    Transport transport;
    std::vector<ParameterInfo> parameters;
    std::vector<ResourceDeclaration> resources; ///< only the fields that `set_fields` names were given
    std::map<std::string, std::vector<std::string>> set_fields;
    std::vector<NodeEntry> nodes;
    std::vector<std::filesystem::path> files; ///< the file and what it extends, and so on
};

/// Finds a graph by path, or by name in the assets' graphs folder; both with or without ".json". Throws Error with the
/// nearest.
std::filesystem::path find_graph(const std::string& name);
/// Throws Error that lists every error of the file, and of those that it extends.
GraphFile read_graph_file(const std::filesystem::path& path);

} // namespace bounce
