#pragma once
// What a pass sees while it executes: its slots, the scene, and commands that bind everything by name. What it asks for
// is recorded, and is from then on an input of the pass: a change of it makes the pass run again.

#include "gpu_scene/frame_constants.h"
#include "gpu_scene/gpu_scene.h"
#include "graph/model.h"

#include <functional>
#include <initializer_list>

namespace bounce {

class Graph;

/// Which draws, and how.
struct DrawOptions {
    enum class Which { all, static_only, dynamic_only };
    Which which = Which::all;
    bool cull_back_faces = false; ///< of materials that are not double-sided
    bool y_turned = false;        ///< the projection turns y over (the camera's does): front faces are clockwise
    int instances = 1;            ///< gl_InstanceID = 0 … instances − 1 (layers of a layered draw)
    /// Skips draws; the index is that of PassContext::draws.
    std::function<bool(int draw)> keep;
};

/// A framebuffer made of slots. Layer −1: all layers (layered rendering).
struct Targets {
    std::vector<std::string> colours;
    std::string depth;
    int mip = 0;
    int layer = -1;
    glm::ivec2 size{0}; ///< of a framebuffer without attachments (fragments that only store to images)
};

class PassContext {
  public:
    PassContext(Graph& graph, const PlanPass& pass, PassInputs& inputs, int step)
        : iteration(step), graph_(graph), pass_(pass), inputs_(inputs) {}

    const int iteration; ///< the step of a repeated pass
    /// What the scene holds: fact(&SceneFacts::triangles).
    template <class T>
    const T& fact(T SceneFacts::*member) const {
        inputs_.facts.insert({offset_of(member), sizeof(T)});
        return facts().*member;
    }
    /// A constant of the frame: frame(&FrameConstants::time).
    template <class T>
    const T& frame(T FrameConstants::*member) const {
        inputs_.frame.insert({offset_of(member), sizeof(T)});
        return frame().*member;
    }
    const std::vector<GpuDraw>& draws() const;
    const std::vector<GpuLight>& lights() const;
    const std::vector<Material>& materials() const;
    const Revision& revision(ScenePart part) const;
    /// Copies of what was uploaded, read back: for what is built on the CPU and kept. Stalls.
    std::vector<Vertex> read_vertices() const;
    std::vector<uint32_t> read_indices() const;
    const GpuTexture& environment() const;
    const PlanPass& plan() const { return pass_; }

    /// The whole texture or buffer behind a slot. Throws Error when the slot has none (a skipped producer).
    const GpuTexture& texture(const std::string& slot) const;
    const Buffer& buffer(const std::string& slot) const;
    bool has(const std::string& slot) const;
    /// A number by name, as expressions in graph files see it: a graph or pass parameter, a side of a resource.
    std::optional<double> number(const std::string& name) const;
    /// The value of an expression of the graph file at this step, ≥ 0.
    int integer(const std::string& expression) const;
    /// Size of a texture slot at the mip that it is bound to in this step.
    glm::ivec3 size(const std::string& slot) const;
    /// What earlier frames left in a slot's resource (incremental, persistent) stands; false when it was just reset.
    bool stands(const std::string& slot) const;

    /// The value of a constant announced by PassDescription::constant, for the next dispatch or draw.
    void set(const std::string& name, const ParameterValue& value);

    /// Images and samplers of that slot see mip `mip` of its texture alone, for the next dispatches (for passes that
    /// walk a mip chain themselves).
    void bind_mip(const std::string& slot, int mip);

    /// At least so many invocations (rounded up to whole groups).
    void dispatch(const std::string& program, glm::ivec3 threads);
    void dispatch_indirect(const std::string& program, const std::string& slot, GLintptr offset = 0);
    /// What this pass wrote so far is seen by its dispatches, draws, copies and reads from here on. Between passes the
    /// graph does that by itself.
    void barrier();
    /// Draws the scene with the state that is set (glEnable …), binding each material's textures. State is put back to
    /// the graph's defaults by the caller: use a Raster object.
    void draw_scene(const std::string& program, const Targets& targets, const DrawOptions& options = {});
    /// One triangle that covers the target; gl_VertexID 0 … 2.
    void draw_fullscreen(const std::string& program, const Targets& targets);
    /// `count` vertices of no attributes (points, lines, triangles).
    void draw_arrays(const std::string& program, const Targets& targets, GLenum mode, int count, int instances = 1);
    /// The same, with count and instances from a buffer (glDrawArraysIndirect's four numbers).
    void draw_arrays_indirect(const std::string& program, const Targets& targets, GLenum mode, const std::string& slot,
                              GLintptr offset = 0);

  private:
    const SceneFacts& facts() const;
    const FrameConstants& frame() const;
    const GpuScene& scene(std::initializer_list<ScenePart> parts) const;
    const PlanSlot& slot(const std::string& name) const;
    int index_at(const std::string& expression) const;
    int mip_of(const PlanSlot& slot) const;
    Program& use(const std::string& program);
    void bind_targets(const Targets& targets);

    Graph& graph_;
    const PlanPass& pass_;
    PassInputs& inputs_;
    std::vector<std::pair<std::string, ParameterValue>> constants_;
    std::vector<std::pair<std::string, int>> mips_; ///< by slot: see bind_mip
};

} // namespace bounce
