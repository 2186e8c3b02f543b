#pragma once
// Frozen pictures with all that made them: to be looked at side by side, told apart in words, and kept as a page.

#include "app/ui/panel_context.h"
#include "core/image.h"
#include "gpu/objects.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

struct Snapshot {
    std::string name;              ///< "1: lrsm_tuned"
    Image8 picture;                ///< as it was displayed, row 0 at the top
    std::string graph, graph_text; ///< name, and the whole graph as it was set (JSON)
    std::string shot_text;         ///< the shot as it was, camera and lights included (JSON)
    std::string command;           ///< that makes the picture, where there is one
    double ms = 0;
    bool ms_current = true; ///< measured of these settings
    uint64_t bytes = 0;
    std::vector<std::pair<std::string, double>> passes;       ///< GPU ms
    std::vector<std::pair<std::string, std::string>> figures; ///< of the comparison, in words: "bias", "−3.1 %"
    GpuTexture texture;                                       ///< of `picture`, made when it is looked at
};

enum class SnapshotView { off, one, wipe, flicker };

struct Snapshots {
    std::vector<Snapshot> all;
    int left = -1, right = -1; ///< of the view; −1: the picture as it is now
    SnapshotView view = SnapshotView::off;
    float wipe = 0.5f; ///< share of the width that shows `left`
    int taken = 0;     ///< so far, for names

    /// What the view shows beside the present picture; null: that one.
    const GpuTexture* texture(int index);
    void remove(int index);
    void release_gpu();
};

/// Throws Error when the graph makes no display picture.
void take_snapshot(PanelContext& context);

/// In lines, what was set otherwise in `b` than in `a`: values and switches as a graph file over a's graph would have
/// them, then lines of the shot. Empty: nothing.
std::string snapshot_difference(const Snapshot& a, const Snapshot& b);

/// All of them as one page with pictures, figures and what each differs from the first in.
std::string snapshots_page(const Snapshots& snapshots);

} // namespace bounce
