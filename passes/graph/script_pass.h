#pragma once
// The pass of type `compute`: a .comp file and an entry in a graph file, with no C++.

#include "graph/graph_file.h"
#include "graph/pass.h"

namespace bounce {

class ScriptPass : public Pass {
  public:
    /// Its entry in the graph file; called before describe.
    void configure(const NodeEntry& entry) { entry_ = entry; }
    void describe(PassDescription& description) override;
    void declare(Declaration& declaration) override;
    void execute(PassContext& context) override;

  private:
    NodeEntry entry_;
};

/// A pass of the entry's type, at its defaults. Throws Error for an unknown type.
std::unique_ptr<Pass> make_pass(const NodeEntry& entry);

} // namespace bounce
