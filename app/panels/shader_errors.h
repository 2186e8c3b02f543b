#pragma once
// What is wrong with a graph's shaders, for the shaders panel and the status bar.

#include "graph/graph.h"

namespace bounce {

/// Rows that the shaders panel shows: every error of a pass's programs, and every program that is disabled.
std::vector<GraphProblem> shader_problems(const Graph& graph);
int shader_error_count(const Graph& graph);

enum class ProgramState { good, not_compiled, old_text, failed, disabled };
/// Newest text, none yet (its pass is skipped), the last good program in place of a wrong text, nothing at all (its
/// pass is magenta), or let go of because it hung the GPU.
ProgramState program_state(const Program& program);

} // namespace bounce
