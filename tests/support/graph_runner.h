#pragma once
// Runs a graph file on an empty scene, for tests of the graph itself.

#include "graph/graph.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

class GraphRunner {
  public:
    explicit GraphRunner(const std::filesystem::path& file, glm::ivec2 picture = {16, 8})
        : size(picture), gpu_scene_(Scene{}, Environment{}), graph(file, TimerMode::finish) {
        gpu_scene_.update(SceneState{});
    }

    glm::ivec2 size;
    SceneFacts facts;
    FrameConstants constants; ///< of the next frame, but for resolution and frame_index

    /// Plans (throws Error for a bad graph, the first time) and renders one frame.
    void frame(int count = 1) {
        for (int i = 0; i < count; ++i) {
            graph.prepare(facts, size);
            FrameInputs inputs;
            inputs.scene = &gpu_scene_;
            inputs.facts = &facts;
            inputs.constants = constants;
            inputs.constants.resolution = size;
            inputs.constants.frame_index = frame_index++;
            graph.execute(inputs);
        }
    }
    std::vector<float> read(const std::string& resource, int mip = 0) const {
        return graph.texture(resource)->read(mip);
    }
    template <class T>
    std::vector<T> read_buffer(const std::string& resource) const {
        return graph.buffer(resource)->read_all<T>();
    }
    /// Every problem as text, one a line.
    std::string problems() const {
        std::string text;
        for (const GraphProblem& problem : graph.problems())
            text += problem.error.text() + "\n";
        return text;
    }
    const PlanPass& pass(const std::string& id) const {
        for (const PlanPass& known : graph.plan().passes)
            if (known.id == id) return known;
        throw Error("no pass '" + id + "' in the plan");
    }

  private:
    GpuScene gpu_scene_;

  public:
    Graph graph;
    int frame_index = 0;
};

} // namespace bounce
