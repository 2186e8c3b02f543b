#pragma once
// The panels: functions that draw themselves from the session and the window's state.

#include "app/ui/panel_context.h"

namespace bounce {

// Panels: one file each. Each draws into the current ImGui window.
void draw_graph_panel(PanelContext& context);      ///< passes with GPU ms bars, MiB, on/off, reasons when skipped
void draw_nodes_panel(PanelContext& context);      ///< the graph as boxes and wires
void draw_parameters_panel(PanelContext& context); ///< every parameter; origin, reset, copy as --set
void draw_shaders_panel(PanelContext& context);    ///< programs and their errors
void draw_resources_panel(PanelContext& context);  ///< every texture and buffer; chooses ui.viewer
void draw_inspector_panel(PanelContext& context);  ///< exact values under the cursor
void draw_cones_panel(PanelContext& context);      ///< the gather's cones at the pointer's pixel, sphere by sphere
void draw_scene_panel(PanelContext& context);      ///< shot, scene facts, lights, materials, environment
void draw_camera_panel(PanelContext& context);     ///< camera, bookmarks, time
void draw_capture_panel(PanelContext& context);    ///< PNG, EXR, recordings, shot and command line, graph preset
void draw_compare_panel(PanelContext& context);    ///< reference, split, error, the live point on a chart
void draw_stability_panel(PanelContext& context);  ///< a case in which methods fail, on the shown graph; its curve
void draw_time_panel(PanelContext& context);       ///< times, memory, error and change of the last frames
void draw_snapshots_panel(PanelContext& context);  ///< frozen pictures with their settings and figures
void draw_log_panel(PanelContext& context);
void draw_keys_panel(PanelContext& context);

} // namespace bounce
