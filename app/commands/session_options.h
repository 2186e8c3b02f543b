#pragma once
// The options that every rendering command shares.

#include "app/session.h"

#include <CLI/CLI.hpp>

namespace bounce {

struct SessionArguments {
    std::string shot = k_default_shot;
    std::string graph = k_default_graph;
    std::vector<std::string> sets;
    std::vector<std::string> enabled, disabled;
    std::vector<std::string> shader_limits; ///< name=number
    std::string size;
    std::string material_model;
    std::string limits; ///< pretended ones of the driver
    int device = -1;
    bool check_nan = false;
    bool check_hazards = false;

    void add_to(CLI::App& command, bool shot_required);
    /// All but the shot and the graph, for commands that take several.
    void add_settings_to(CLI::App& command);
    static void add_limits_to(CLI::App& command, std::string& limits);
    /// Throws Error when there is no such shot or graph: what comes first on the command line is told first.
    void check_names() const;
    /// Throws Error for a malformed --set. Sets the shader limits and the pretended ones of the driver.
    SessionOptions options() const;
};

} // namespace bounce
