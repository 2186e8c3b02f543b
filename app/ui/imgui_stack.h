#pragma once

namespace bounce {

/// Where Dear ImGui's stack of windows stands, so that what a panel left open when an exception ended it can be closed.
class ImGuiStack {
  public:
    ImGuiStack();
    /// Closes all windows, groups, tables and trees that were opened since, and in the window that was open then.
    void unwind() const;

  private:
    int windows_;
};

} // namespace bounce
