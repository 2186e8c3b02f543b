#pragma once
// The command palette: all that can be done, opened, set or looked at, found by parts of its name.

#include "app/ui/panel_context.h"

#include <functional>
#include <string>
#include <vector>

namespace bounce {

struct PaletteEntry {
    std::string kind; ///< "action", "shot", "graph", "parameter", "view"
    std::string name;
    std::string hint; ///< a key, a value, a help text
    std::function<void()> run;
};

/// Every key's command, shot, graph, parameter and texture. `press` does what a key does.
std::vector<PaletteEntry> palette_entries(const PanelContext& context,
                                          const std::function<void(const std::string& chord)>& press);

/// Indices of the entries that hold every word of `text` in kind, name or hint, whatever the case; those whose name
/// begins with it first.
std::vector<size_t> palette_matches(const std::vector<PaletteEntry>& entries, const std::string& text);

class Palette {
  public:
    bool is_open() const { return open_; }
    void open(std::vector<PaletteEntry> entries);
    /// Draws it while it is open. What a person chooses is asked for (WindowState::ask) and closes it; so do Escape and
    /// a click elsewhere.
    void draw(PanelContext& context);

  private:
    std::vector<PaletteEntry> entries_;
    std::string text_;
    size_t chosen_ = 0;
    bool open_ = false, fresh_ = false;
};

} // namespace bounce
