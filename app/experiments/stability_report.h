#pragma once
// What the stability suite writes: a row a case, a column a graph, and behind each figure the curve over the ladder.

#include "app/experiments/stability_suite.h"
#include "app/origin.h"

namespace bounce {

std::string stability_markdown(const std::vector<StabilityRow>& rows, const Origin& origin);
/// A line for each rung of each cell.
std::string stability_csv(const std::vector<StabilityRow>& rows);
std::string stability_json(const std::vector<StabilityRow>& rows, const Origin& origin);
std::string stability_html(const std::vector<StabilityRow>& rows, const Origin& origin);
/// stability.md, .csv, .json and .html in `folder`. Throws Error.
void write_stability(const std::vector<StabilityRow>& rows, const Origin& origin, const std::filesystem::path& folder);
/// What write_stability wrote into `folder`, failures left out; nothing where there is none. Of the cases, the names.
/// Throws Error for a file of another kind.
std::vector<StabilityRow> read_stability(const std::filesystem::path& folder);
/// "12.3 %", with the mark's verdict: "12.3 % ✗".
std::string cell_text(const StabilityCase& which, const StabilityCell& cell);

} // namespace bounce
