#pragma once
// What was done in the window and can be undone.

#include <functional>
#include <string>
#include <vector>

namespace bounce {

/// One step that can be undone.
struct UndoStep {
    std::string what; ///< "direct.normal_offset"
    std::function<void()> undo, redo;
};

class UndoStack {
  public:
    /// Records a step that was just done; steps with the same `what` within one drag are merged by the caller.
    void push(UndoStep step);
    bool undo();
    bool redo();
    std::string next_undo() const;
    std::string next_redo() const;
    /// Another scene: what was done to the old one is past.
    void clear() { done_.clear(), undone_.clear(); }

  private:
    std::vector<UndoStep> done_, undone_;
};

} // namespace bounce
