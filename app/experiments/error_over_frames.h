#pragma once
// How far a run of frames is from a reference as it goes on: whether an accumulated picture converges, and to what.

#include "app/session.h"
#include "core/comparison.h"

#include <string>

namespace bounce {

class ErrorOverFrames {
  public:
    /// `reference`: an .exr of named parts, of the picture's size or a whole fraction of it. `part`: what is compared;
    /// "": the graph's own parts (its transport) that the reference has, one by one. Throws Error.
    ErrorOverFrames(const std::string& reference, std::string part);

    /// Compares the session's present picture after 1, 4, 16, 64, … frames, and after the last.
    void add(const Session& session, int frames, bool last);

    /// One line for each that was compared, ending in a newline: frames, part, bias, RMSE and the RMSE of 3 × 3 means,
    /// as shares of the reference's mean.
    std::string text() const { return text_; }

  private:
    std::string part_;
    LayeredImage reference_;
    std::string text_;
};

} // namespace bounce
