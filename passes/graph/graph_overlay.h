#pragma once
// A graph file that starts from another (`extends`) says only what it changes, adds and removes. Here such a chain of
// files becomes one whole graph, and two whole graphs become the overlay that leads from one to the other.
// passes/graph/README.md has the rules with examples.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bounce {

using OrderedJson = nlohmann::ordered_json;

/// A graph file together with all that it starts from.
struct WholeGraph {
    OrderedJson root;                         ///< as one file would have it that extends nothing
    std::vector<std::filesystem::path> files; ///< that file first, then what it extends, and so on
    /// "passes.gather", "resources.out.direct", "parameters.scale" → the file that said the last of it
    std::map<std::string, std::string> origins;
};

/// The file's text as JSON. Throws Error with the line for what is no JSON.
OrderedJson parse_graph_text(const std::filesystem::path& path);
/// Throws Error that lists all that is wrong: a base that is not there, a circle, an unknown id, what is to be removed
/// and is not there, each with the nearest name.
WholeGraph expand_graph(const std::filesystem::path& path);
/// The files of a chain as far as they can be found, for watching them while one of them is broken.
std::vector<std::filesystem::path> graph_chain(const std::filesystem::path& path);

/// The file that `extends` names in a graph file: a path beside that file or a name in assets/graphs, with or without
/// ".json". Throws Error with the nearest.
std::filesystem::path find_base_graph(const std::string& name, const std::filesystem::path& extending);
/// What a graph file at `from` writes behind `extends` to start from `base`.
std::string extends_name(const std::filesystem::path& base, const std::filesystem::path& from);

/// The id of an entry of `passes`: its type unless it has one.
std::string pass_id(const OrderedJson& entry);
/// Applies what an overlay says to a whole graph. `file` is named in errors. Throws Error that lists all of them.
void apply_overlay(WholeGraph& graph, const OrderedJson& overlay, const std::string& file);
/// The overlay that makes `to` of `from`, both whole: its members but for version and extends. Empty when they are the
/// same.
OrderedJson graph_departures(const OrderedJson& from, const OrderedJson& to);

/// A value as graph files have it: { "id": "gather", "params": { "interleave": 4 } }
std::string on_one_line(const OrderedJson& value);
/// A graph file's text: no line is wider than 140 columns unless one string is.
std::string graph_text(const OrderedJson& root);

} // namespace bounce
