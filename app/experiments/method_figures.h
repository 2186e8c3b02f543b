#pragma once
// What a chart of all methods tells of a point beside its cost and its error: how it begins, what is left when nothing
// is computed twice, how steady it is, and how far shadows are off where they end.

#include "app/session.h"
#include "core/metrics.h"

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bounce {

/// NaN: not measured, or there is nothing to measure it on.
struct MethodFigures {
    static constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    double first_ms = k_none;          ///< of the first frame, in which everything is made
    double on_change_ms = k_none;      ///< of a later one with graph.rebuild=on_change, in the mean
    double flicker = k_none;           ///< FlickerFigures::flicker of what is compared
    double shadow_edge_share = k_none; ///< of the pixels that are compared: those at edges of shadows
    double shadow_edge_rmse = k_none;  ///< of direct light there, over its mean there
    double direct_rmse = k_none;       ///< of direct light at all other pixels, over its mean there
};

/// Direct light against the reference's, apart at edges of shadows and elsewhere. An edge is where, within 3 × 3 pixels
/// that the mask keeps, the reference's luminance reaches from under 5 % of a value to that value: darker than textures
/// are, and as dark as a shadow is that other lights do not reach.
void add_shadow_errors(MethodFigures& figures, const Image& direct, const Image& reference, const Mask& mask);

/// Renders four more frames of the shot with graph.rebuild=on_change. `resource`: whose flicker is measured.
void add_steady_figures(MethodFigures& figures, Session& session, const std::string& resource);

nlohmann::ordered_json figures_json(const MethodFigures& figures);
MethodFigures figures_from_json(const nlohmann::ordered_json& json);

/// What is told of each, in order: its name in files, its title, its unit (%, ms or none), and where it is kept.
struct FigureColumn {
    const char* name;
    const char* title;
    const char* unit;
    double MethodFigures::*value;
};
const std::vector<FigureColumn>& figure_columns();

} // namespace bounce
