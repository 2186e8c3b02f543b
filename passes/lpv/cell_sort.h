#pragma once
// Sorts entries (texels of maps, pixels) by the cells that they lie in, for each cascade, so that each cell finds its
// own one after the other, in the same order in every run. A pass has two programs: `keys` writes pairs (cell, entry)
// into the slot sort.pairs, `arrange` takes them sorted (glsl/lpv/ranges.glsl).

#include "graph/context.h"

namespace bounce {

/// How many cells there are: the graph's own parameters `cells` and `cascades`, which every pass and shader of it
/// share.
inline constexpr const char* k_lpv_cells = "graph.cascades * graph.cells ^ 3"; ///< an expression
int lpv_cells(const PassContext& context);                                     ///< along each side of a cascade
int lpv_cascades(const PassContext& context);                                  ///< nested grids

/// `pairs`: the resource behind the slot sort.pairs; prefix sums lie beside it.
void describe_cell_sort(PassDescription& description, const std::string& pairs, const std::string& keys,
                        const std::string& arrange);
/// `entries`: an expression.
void declare_cell_sort(Declaration& declaration, const std::string& entries);
/// `cells`: of a cascade. Constants that the programs have beside those of ranges.glsl must be set before.
void run_cell_sort(PassContext& context, int64_t entries, int cells);

} // namespace bounce
