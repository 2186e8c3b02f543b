#pragma once
// Progress on stderr: a bar with the time left on a terminal, when it takes longer than a second; else plain lines.

#include <string>

namespace bounce {

class Progress {
  public:
    explicit Progress(std::string what);
    ~Progress();
    /// `share` in [0, 1].
    void update(double share);

  private:
    std::string what_;
    double start_, shown_ = 0;
    bool terminal_;
    bool drawn_ = false;
    double next_line_ = 0.25;
};

} // namespace bounce
