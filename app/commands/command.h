#pragma once
// Subcommands: one file each. A command adds its options to the command line and names what runs.

#include <CLI/CLI.hpp>
#include <functional>

namespace bounce {

/// Returns the exit code. Bad input is thrown as Error (exit code 2).
using CommandFunction = std::function<int()>;

/// Adds a subcommand to `app`; when it is chosen, `chosen` is set to what runs it.
void add_view_command(CLI::App& app, CommandFunction& chosen);
void add_render_command(CLI::App& app, CommandFunction& chosen);
void add_graph_command(CLI::App& app, CommandFunction& chosen);
void add_params_command(CLI::App& app, CommandFunction& chosen);
void add_info_command(CLI::App& app, CommandFunction& chosen);
void add_new_command(CLI::App& app, CommandFunction& chosen);
void add_shaders_command(CLI::App& app, CommandFunction& chosen);
void add_reference_command(CLI::App& app, CommandFunction& chosen);
void add_compare_command(CLI::App& app, CommandFunction& chosen);
void add_chart_command(CLI::App& app, CommandFunction& chosen);
void add_table_command(CLI::App& app, CommandFunction& chosen);
void add_ablate_command(CLI::App& app, CommandFunction& chosen);
void add_stability_command(CLI::App& app, CommandFunction& chosen);
void add_tune_command(CLI::App& app, CommandFunction& chosen);
void add_list_command(CLI::App& app, CommandFunction& chosen);
void add_completion_command(CLI::App& app, CommandFunction& chosen);

/// What a person sees first: global illumination.
inline constexpr const char* k_first_graph = "lrsm_tuned";
int view_default();
/// What `bounce` does without arguments: the window where there is a display, else the default shot to a file.
int run_default();

} // namespace bounce
