#pragma once
// Between a graph file and its plan: passes as declared, whose names are not resolved to resources yet.

#include "core/error.h"
#include "graph/model.h"

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
    std::string declined;           ///< reason, or empty
    bool faulty = false;            ///< an error of it has been told
};

/// Slots of the scene's own resources, which no pass makes.
bool is_builtin(const std::string& slot);
bool has_writer(const std::vector<Declared>& passes, const std::string& resource);
/// Every slot must have a resource of its kind that something writes. `incomplete`: there may be more resources and
/// passes than these, so that what lacks a source is no error.
void check_sources(std::vector<Declared>& passes, const std::vector<ResourceDeclaration>& resources, bool incomplete,
                   ErrorList& errors);
/// Indices of the passes that have not declined, in the order in which they run: a reader comes after every writer
/// listed before it, or, when none is, after all writers; writers keep their order. Those of a circle are left out.
std::vector<int> order_passes(const std::vector<Declared>& passes, const std::vector<ResourceDeclaration>& resources,
                              ErrorList& errors);

} // namespace bounce
