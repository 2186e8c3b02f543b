#pragma once
// What a measured point was measured with: the program, the graph, the shaders and the shot, as digests. Points of
// other contents are other points, and are never mixed.

#include "app/experiments/chart_point.h"

#include <map>
#include <string>
#include <vector>

namespace bounce {

/// Finds the contents of tasks; what several share is read once.
class ContentReader {
  public:
    /// Throws Error when the shot, the graph or a parameter is bad.
    PointContent content_of(const PointTask& task);
    /// Of the graph with the shaders of all its passes. Throws Error when it is bad.
    std::string graph_digest(const std::string& graph);

  private:
    struct GraphContent {
        std::string text;
        std::map<std::string, std::string> shaders; ///< of every pass
    };
    const GraphContent& graph_content(const std::string& graph);

    std::map<std::string, GraphContent> graphs_;
    std::map<std::pair<std::string, int>, std::string> shots_;
    std::map<std::string, std::pair<SceneFacts, glm::ivec2>> facts_;
};

/// What is not the same in two contents, in words ("the program (1a2b, now 3c4d)", "the shaders of 'direct'").
std::vector<std::string> content_differences(const PointContent& before, const PointContent& now);

/// Points that may stand in one chart: those that agree with the newest in program, and in the text of a graph and in
/// the content of a shot where they name the same. `left_out` gets a line for each of the others, which says why.
std::vector<ChartPoint> points_of_one_program(std::vector<ChartPoint> points, std::vector<std::string>& left_out);

} // namespace bounce
