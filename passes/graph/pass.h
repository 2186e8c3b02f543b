#pragma once
// The pass interface: describe its parameters, declare what it reads and writes, execute.

#include "core/parameters.h"
#include "gpu/program.h"
#include "graph/pass_inputs.h"
#include "graph/resource.h"
#include "scene/scene.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

class PassContext;

/// How a slot is used; barriers follow from it.
enum class Usage { sampled, image, storage, colour, depth, indirect };

struct SlotUse {
    std::string slot; ///< name with the dot
    Usage usage = Usage::sampled;
    bool reads = true;
    bool writes = false;
    bool optional = false;                           ///< reads the neutral value when nothing produces it
    std::string where;                               ///< for errors: "surface/direct.comp:12" or the pass id
    std::optional<glm::vec4> neutral = std::nullopt; ///< as declared with the slot
    std::string required_if = {};                    ///< expression over the pass's parameters: not optional then
};

/// One program of a pass.
struct ProgramEntry {
    std::string name;
    std::vector<std::filesystem::path> stages;
};

/// What a pass tells once, at its birth.
class PassDescription {
  public:
    explicit PassDescription(ParameterSet& set) : parameters(set) {}
    ParameterSet& parameters;
    /// A program of this pass; its //! parameters join the pass's parameters.
    void program(const std::string& name, std::vector<std::filesystem::path> stages) {
        programs.push_back({name, std::move(stages)});
    }
    /// A uniform that execute() sets by PassContext::set (a draw's index, say).
    void constant(const std::string& name) { constants.push_back(name); }
    /// The slot is bound to that resource unless the graph file binds another.
    void bind(const std::string& slot, const std::string& resource) { bindings[slot] = resource; }

    std::vector<ProgramEntry> programs;
    std::vector<std::string> constants;
    std::map<std::string, std::string> bindings;
};

/// A number that a pass keeps on the GPU, shown in the graph panel and in reports.
struct CounterDeclaration {
    std::string label;     ///< "layers stored"
    std::string buffer;    ///< a resource of 4-byte integers that the pass makes
    uint64_t element = 0;  ///< which of them
    bool overflow = false; ///< above 0 it tells that something was left out
};

/// What a pass reads and writes, as a function of its parameters and the scene.
class Declaration {
  public:
    Declaration(const SceneFacts& scene_facts, glm::ivec2 picture,
                std::function<std::vector<ShaderSlot>(const std::string&)> slots)
        : facts_(scene_facts), picture_size_(picture), slots_of_(std::move(slots)) {}

    /// What the scene holds: fact(&SceneFacts::triangles). What is asked for is an input of the pass, as far as what it
    /// remembers of it for execute().
    template <class T>
    const T& fact(T SceneFacts::*member) {
        facts_read_.insert({offset_of(member), sizeof(T)});
        return facts_.*member;
    }
    glm::ivec2 picture_size() {
        picture_size_read_ = true;
        return picture_size_;
    }

    /// Makes a resource that this pass writes. (The graph file may change its format or size.)
    ResourceDeclaration& creates(const std::string& name, ResourceKind kind, const std::string& format, Extent extent);
    ResourceDeclaration& creates_buffer(const std::string& name, const std::string& count, int stride);
    void reads(const std::string& slot, Usage usage) { uses_.push_back({slot, usage, true, false, false, ""}); }
    void reads_optional(const std::string& slot, Usage usage) { uses_.push_back({slot, usage, true, false, true, ""}); }
    void writes(const std::string& slot, Usage usage) { uses_.push_back({slot, usage, false, true, false, ""}); }
    void reads_and_writes(const std::string& slot, Usage usage) {
        uses_.push_back({slot, usage, true, true, false, ""});
    }
    /// This pass runs that program: every slot of its shaders, with the access that they declare.
    void uses(const std::string& program);
    void counts(const std::string& label, const std::string& buffer, uint64_t element, bool overflow = false) {
        counters_.push_back({label, buffer, element, overflow});
    }
    const std::vector<CounterDeclaration>& counters() const { return counters_; }
    /// Execute is called for iteration = from, …, to − 1, with barriers between. Passes that follow one another and
    /// name the same `loop_name` go through their steps together: step 0 of each, then step 1 of each, … (a structure
    /// that is built and used in batches).
    void repeat(int from, int to, const std::string& loop_name = {}) {
        repeat_from = from, repeat_to = to;
        loop = loop_name;
    }

    /// The programs that this pass runs with these parameters; the others are not built.
    const std::vector<std::string>& programs() const { return programs_; }
    const std::vector<SlotUse>& slot_uses() const { return uses_; }
    const std::vector<ResourceDeclaration>& resources() const { return resources_; }
    const std::set<ByteRange>& facts_read() const { return facts_read_; }
    bool picture_size_read() const { return picture_size_read_; }
    int repeat_from = 0, repeat_to = 1;
    std::string loop;

  private:
    const SceneFacts& facts_;
    glm::ivec2 picture_size_;
    std::set<ByteRange> facts_read_;
    bool picture_size_read_ = false;
    std::function<std::vector<ShaderSlot>(const std::string&)> slots_of_;
    std::vector<SlotUse> uses_;
    std::vector<std::string> programs_;
    std::vector<CounterDeclaration> counters_;
    std::vector<ResourceDeclaration> resources_;
};

class Pass {
  public:
    virtual ~Pass() = default;
    virtual void describe(PassDescription& description) = 0;
    /// A reason why this scene does not need the pass ("no emissive material"); empty when it does.
    virtual std::string skip_reason(const SceneFacts&) const { return {}; }
    /// What readers get instead of what this pass makes when it is skipped: {made, instead}.
    virtual std::vector<std::pair<std::string, std::string>> fallbacks() const { return {}; }
    virtual void declare(Declaration& declaration) = 0;
    virtual void execute(PassContext& context) = 0;
    /// Told what the pass counted in a frame, in the order of its `counts` (numbers only). True: a buffer was too
    /// small, and the pass wants to be planned again, with more (a window shows that in the next frame, headless runs
    /// render the frame again).
    virtual bool needs_larger_buffers(const std::vector<int64_t>&) { return false; }
    /// One of its C++ parameters was set: what it had grown to was for other settings. It starts as a fresh one does,
    /// so that it comes to the same batches.
    virtual void reset_capacity() {}
};

struct PassType {
    std::string name;
    std::string about;
    std::function<std::unique_ptr<Pass>()> make;
};
/// Every registered pass type, by name.
const std::vector<PassType>& pass_types();
bool register_pass(PassType type);

/// One line at the end of a pass's file makes it known to graph files.
#define BOUNCE_REGISTER_PASS(name, Class, about)                                                                       \
    static const bool bounce_registered_##Class =                                                                      \
        ::bounce::register_pass({name, about, [] { return std::make_unique<Class>(); }});

} // namespace bounce
