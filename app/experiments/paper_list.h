#pragma once
// Every table and figure of the papers: the command that makes ours and where it is kept, or why there is none.
//   { "about": "…", "papers": [{"name": "LRSM", "title": "…", "figures": 8, "tables": 3, "items": [
//     {"item": "Figure 7", "shows": "…", "command": "bounce table lrsm_errors", "result": "lrsm_errors.md", "note":
//     "…"},
//     {"item": "Table I", "shows": "…", "reason": "…"}]}] }
// Results are paths from assets/results. Each figure 1 … `figures` and table 1 … `tables` stands there once; DVS counts
// its tables by Roman numerals.

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

struct PaperItem {
    std::string item, shows;
    std::string note;                    ///< how ours is another than theirs
    std::string command, result, reason; ///< "": none. A result has its command; without a result there is a reason
};

struct Paper {
    std::string name, title;
    std::vector<PaperItem> items;
};

struct PaperList {
    std::string about;
    std::vector<Paper> papers;
};

/// It lies among the results that it links to, which no bundle holds.
std::filesystem::path paper_list_path();

/// Throws Error that lists every problem: an item without a result and without a reason, a result that is not there, a
/// figure or table that is missing or named twice.
PaperList load_paper_list(const std::filesystem::path& path);

std::string paper_list_markdown(const PaperList& list);

} // namespace bounce
