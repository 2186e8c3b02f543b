#pragma once
// Between a graph file and its plan: the passes as declared, whose names are not resolved to resources yet, and the
// phases that a plan goes through. A phase reports all of its errors together; the next one runs only without any, so
// that no error merely follows from another.

#include "core/error.h"
#include "graph/model.h"
#include "graph/scope.h"

#include <map>
#include <set>

namespace bounce {

struct Declared {
    const PassNode* node = nullptr;
    std::vector<SlotUse> uses;
    std::vector<std::string> programs; ///< that it runs
    std::vector<CounterDeclaration> counters;
    std::vector<BindEntry> targets; ///< per use: the resource it points at
    int repeat_from = 0, repeat_to = 1;
    std::string loop;
    std::set<ByteRange> facts_read; ///< by its declaration
    bool picture_size_read = false; ///< likewise
    std::string skipped;            ///< reason, or empty
};

/// What a plan is made of.
struct PlanDraft {
    const GraphModel& model;
    const SceneFacts& facts;
    glm::ivec2 size; ///< the picture's
    std::vector<Declared> passes;
    std::vector<ResourceDeclaration> resources;

    ResourceDeclaration* find(const std::string& name);
    const ResourceDeclaration* find(const std::string& name) const;
    bool has_writer(const std::string& resource) const;
    /// Something writes it, but nothing that runs.
    bool all_writers_skipped(const std::string& resource) const;
};

/// The sizes of the resources of a draft, each evaluated when it is first asked for.
class PlanSizes {
  public:
    PlanSizes(PlanDraft& draft, ErrorList& errors);
    const PlanResource& of(const std::string& resource);
    /// Names of expressions.
    Names names() const { return scope_.names(); }
    std::optional<double> number(const std::string& name) const { return scope_.number(name); }

  private:
    PlanDraft& draft_;
    ErrorList& errors_;
    Scope scope_;
    std::map<std::string, PlanResource> sized_;
    std::set<std::string> sizing_; ///< to find those that depend on themselves
};

/// Slots of the scene's own resources, which no pass makes.
bool is_builtin(const std::string& slot);

// --- the phases, in order ---

/// Every pass declares; the file's resources and theirs are joined.
void declare_passes(PlanDraft& draft, ErrorList& errors);
/// Every slot must have a resource of its kind that something writes, and every slot that the file binds be there.
void check_sources(const PlanDraft& draft, ErrorList& errors);
/// Skips what the scene does not need, what only feeds that, and what only that feeds.
void skip_passes(PlanDraft& draft, PlanSizes& sizes, ErrorList& errors);
/// The steps of repeated passes.
void resolve_repeats(PlanDraft& draft, PlanSizes& sizes, ErrorList& errors);
/// Indices of the passes that are not skipped, in the order in which they run: a reader comes after every writer
/// listed before it, or, when none is, after all writers; writers keep their order. Those of a circle are left out.
std::vector<int> order_passes(const PlanDraft& draft, ErrorList& errors);
/// What would otherwise only fail when a frame runs: dispatch sizes, bound mips and layers, samplers and images of
/// another kind than their resource.
void check_plan(const GraphModel& model, const SceneFacts& facts, const Plan& plan, ErrorList& errors);

} // namespace bounce
