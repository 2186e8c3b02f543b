#pragma once
// One parameter taken over its range on the picture that is shown: time and error of each value.

#include "app/panels/parameter_edit.h"

namespace bounce {

/// Values of a parameter that a sweep tries, in order: all choices, false and true, or at most `most` numbers from one
/// end of its range to the other, in equal ratios where its slider has them. Empty: it has no such range.
std::vector<std::string> sweep_values(const ParameterInfo& info, size_t most = 7);

class ParameterSweep {
  public:
    struct Point {
        std::string value;
        double ms = 0;       ///< all passes, median of a few frames
        double error = -1;   ///< by the metric of the Compare panel; −1: there is no reference to compare with
        std::string refused; ///< why the graph cannot run with it
    };

    /// Throws Error when the parameter has no range. It goes on between frames, a value at a time, until it is done or
    /// stopped; then the parameter is as it was.
    static void start(PanelContext& context, const std::string& name);
    void stop() { stopped_ = true; }
    bool running() const { return next_ < values_.size() && !stopped_; }
    const std::string& name() const { return name_; }
    const std::vector<Point>& points() const { return points_; }
    /// "3 of 7".
    std::string progress() const;

  private:
    void step(PanelContext& context);

    std::string name_, metric_;
    std::vector<std::string> values_;
    std::vector<Point> points_;
    size_t next_ = 0;
    bool stopped_ = false;
};

/// What was found, as two curves; nothing while there was no sweep.
void draw_sweep(PanelContext& context);

} // namespace bounce
