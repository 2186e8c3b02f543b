#pragma once
// Tables of errors: each row is a shot through a graph with some settings, held to the reference of the row's
// transport.
//   { "about": "…", "shot": "cornell", "size": [128, 128], "samples": 1024, "resource": "out.indirect_diffuse",
//     "bounces": 1, "diffuse_only": true, "surfaces": 6, "metrics": ["bias", "flip"],
//     "rows": [{"name": "as published", "graph": "lrsm"},
//              {"name": "walk", "graph": "lrsm_tuned", "set": {"gather.hit_lookup": "map"}, "multiple": 2},
//              {"name": "and more", "adds": true, "set": {…}, "requires": "sponza/Sponza.gltf"}] }
// A row may give any of shot, size, samples, resource, bounces, diffuse_only, multiple, frames, window and requires for
// itself;
// a row whose scene `requires` is not on the search path is skipped. `adds`: the settings of the row before hold, too.
// `multiple`: the picture is that many times as wide and high as the reference, and is compared by means. `window`: the
// relative RMSE is told also after means over so many pixels a side of both (odd).

#include "app/experiments/sweep.h"
#include "core/metric_table.h"

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

struct ErrorTableRow {
    std::string name, shot, graph, resource = "out.indirect_diffuse";
    std::string required_scene; ///< "": none beside the shot's
    ParameterValues sets;
    std::vector<std::pair<std::string, bool>> switches; ///< pass → on or off
    glm::ivec2 size{128};                               ///< of the reference
    int multiple = 1, frames = 1, samples = 1024, window = 1;
    std::optional<int> bounces; ///< of the reference; else the graph's own transport
    std::optional<bool> diffuse_only;
};

struct ErrorTableFile {
    std::string about;
    std::vector<std::string> metrics = {"bias", "relative_rmse_denoised"}; ///< a column each
    int surfaces = 0; ///< columns of single surfaces, the largest of the first row's shot
    std::vector<ErrorTableRow> rows;
};

struct SurfaceError {
    std::string name; ///< material and axis
    double bias = 0;
    size_t pixels = 0;
};

/// What a row measured.
struct ErrorTableMeasured {
    std::string skipped;           ///< the reason, where the row could not be measured: its scene is not there
    std::string autos;             ///< values that follow the scene's needs: "voxelization.resolution=256"; "" for none
    bool absolute = false;         ///< errors are told in AO units
    MetricValues errors, windowed; ///< the latter where the row has a window
    double frame_ms = 0;
    uint64_t bytes = 0;
    std::vector<SurfaceError> surfaces; ///< those that hold 1 % of the pixels or more, the largest first
};

/// Whether the file is a table of errors (it has "rows"); a table of costs has "columns".
bool is_error_table(const std::filesystem::path& path);

/// Throws Error that lists every problem.
ErrorTableFile load_error_table(const std::filesystem::path& path);

/// Renders the row and its reference. Throws Error; a scene that is not there is a skipped row.
ErrorTableMeasured measure_row(const ErrorTableRow& row, const std::function<void(const std::string&)>& report);

std::string error_table_markdown(const ErrorTableFile& file, const std::vector<ErrorTableMeasured>& measured);

} // namespace bounce
